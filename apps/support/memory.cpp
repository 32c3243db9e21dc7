#include "apps/support/memory.hpp"

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace listric {

namespace {

std::atomic<double> need = 0.0;

} // namespace

void note_memory_need(double bytes) { need = bytes; }

double noted_memory_need() { return need; }

namespace {

std::atomic<void*> reserve = nullptr;

} // namespace

void keep_memory_for_the_end() {
    constexpr std::size_t size = 1 << 20;
    std::free(reserve.exchange(std::malloc(size)));
    std::set_new_handler([] {
        std::free(reserve.exchange(nullptr));
        throw std::bad_alloc();
    });
}

} // namespace listric
