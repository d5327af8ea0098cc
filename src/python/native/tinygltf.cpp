// The functions of tinygltf, for the wheel. Debian's package has them in a shared library only.
#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
