#include "apps/program.hpp"

int main(int argc, char** argv) { return listric::program(argc, argv); }
