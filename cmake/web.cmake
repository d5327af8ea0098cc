# Toolchain: WebAssembly without threads, with Debian's package emscripten.
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
add_compile_options(-fwasm-exceptions "SHELL:-include ${CMAKE_CURRENT_LIST_DIR}/../src/web/libcxx13.hpp")
add_link_options(-fwasm-exceptions)
set(CMAKE_POSITION_INDEPENDENT_CODE OFF)
