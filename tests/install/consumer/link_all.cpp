#include <listric/archive.hpp>
#include <listric/coupling.hpp>
#include <listric/footwall.hpp>

int main(int argc, char** argv) {
    if (argc > 1)
        listric::archive::read_snapshot(argv[1]);
}
