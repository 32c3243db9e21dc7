#pragma once

#include <cstddef>
#include <vector>

namespace listric::dem {

/// Memory that starts at a cache line. Large pieces ask the system for large pages: with pages of
/// 4 kB the processor drops prefetches whose page it has not at hand.
void* allocate_aligned(std::size_t bytes);
void free_aligned(void* memory, std::size_t bytes);

template <class T> struct AlignedAllocator {
    using value_type = T;
    AlignedAllocator() = default;
    template <class U> AlignedAllocator(const AlignedAllocator<U>&) {}
    T* allocate(std::size_t n) { return static_cast<T*>(allocate_aligned(n * sizeof(T))); }
    void deallocate(T* memory, std::size_t n) { free_aligned(memory, n * sizeof(T)); }
    bool operator==(const AlignedAllocator&) const { return true; }
};

template <class T> using AlignedVector = std::vector<T, AlignedAllocator<T>>;

} // namespace listric::dem
