// A test compares the files that this program writes in both build modes. Usage: results FILE
#include "header_only/results.hpp"

int main(int, char** arguments) { return write_results(arguments[1]) ? 0 : 1; }
