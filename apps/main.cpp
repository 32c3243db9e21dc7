#include "apps/commands/program.hpp"

int main(int argc, char** argv) { return listric::program(argc, argv); }
