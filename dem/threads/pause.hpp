#pragma once

#if defined __SSE2__
#include <immintrin.h>
#endif

namespace listric::dem {

/// A moment of waiting awake, some tens of cycles of the processor, that leaves the core's
/// resources to others.
inline void pause() {
#if defined __SSE2__
    _mm_pause();
#endif
}

} // namespace listric::dem
