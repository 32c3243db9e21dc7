// Prints the hash of the state that LIS1 comes to, driven from C++.

#include "drive_lis1.hpp"

#include <cstdio>

int main() { std::printf("%016llx\n", static_cast<unsigned long long>(drive_lis1(1))); }
