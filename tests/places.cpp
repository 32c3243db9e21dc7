#include "tests/places.hpp"

#ifndef LISTRIC_FOOTWALL_PROGRAM
#define LISTRIC_FOOTWALL_PROGRAM ""
#endif

namespace listric {

constinit const char* const program_path = LISTRIC_PROGRAM;
constinit const char* const source_folder = LISTRIC_SOURCE_DIR;
constinit const char* const footwall_program = LISTRIC_FOOTWALL_PROGRAM;

} // namespace listric
