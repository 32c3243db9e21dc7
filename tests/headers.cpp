// Compiles what most tests include, once for all of them (CMakeLists.txt).
