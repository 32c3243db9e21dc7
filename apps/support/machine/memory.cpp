#include "apps/support/machine/memory.hpp"

#include <fmt/format.h>

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <sys/resource.h>

namespace listric {

namespace {

std::atomic<double> need = 0.0;

} // namespace

void note_memory_need(double bytes) { need = bytes; }

double noted_memory_need() { return need; }

std::string words_of(const std::exception& error) {
    return dynamic_cast<const std::bad_alloc*>(&error) ? "memory is short" : error.what();
}

std::string words_of_address_limit() {
    rlimit addresses{};
    if (getrlimit(RLIMIT_AS, &addresses) != 0 || addresses.rlim_cur == RLIM_INFINITY)
        return "";
    return fmt::format("; the limit of {:.0f} MB (ulimit -v) is for the program and its libraries, "
                       "too",
                       static_cast<double>(addresses.rlim_cur) / 1e6);
}

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
