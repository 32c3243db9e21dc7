#include "dem/cycle/aligned_vector.hpp"

#include <new>

#if defined __linux__
#include <sys/mman.h>
#endif

namespace listric::dem {

namespace {

constexpr std::size_t large_page = std::size_t{1} << 21;

std::align_val_t alignment(std::size_t bytes) {
    return std::align_val_t(bytes < large_page ? 64 : large_page);
}

} // namespace

void* allocate_aligned(std::size_t bytes) {
    void* memory = ::operator new(bytes, alignment(bytes));
#if defined __linux__
    if (bytes >= large_page)
        madvise(memory, bytes, MADV_HUGEPAGE); // advice: without it everything works, slower
#endif
    return memory;
}

void free_aligned(void* memory, std::size_t bytes) { ::operator delete(memory, alignment(bytes)); }

} // namespace listric::dem
