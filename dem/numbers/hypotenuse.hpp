#pragma once

#include <cmath>

namespace listric::dem {

/// sqrt(a^2 + b^2) for a >= b > 0 whose squares are numbers of full precision: the rounded root,
/// less half of what its square is too large by over itself. That excess comes from differences
/// without cancellation (C. F. Borges, "An improved algorithm for hypot(a, b)", 2019).
inline double corrected_root(double a, double b) {
    const double root = std::sqrt(a * a + b * b);
    double excess;
    if (root <= 2.0 * b) {
        const double more = root - b;
        excess = a * (2.0 * more - a) + (more - 2.0 * (a - b)) * more;
    } else {
        const double more = root - a;
        excess = 2.0 * more * (a - 2.0 * b) + ((4.0 * more - b) * b + more * more);
    }
    return root - excess / (2.0 * root);
}

/// The length of (a, b), a >= b, where squares overflow or vanish, or one is infinite or NaN.
inline double far_hypotenuse(double a, double b) {
    if (std::isinf(a) || std::isinf(b))
        return HUGE_VAL;
    // A leg below half of the other's last digit is lost in the sum.
    if (std::isnan(a) || std::isnan(b) || a >= 0x1p54 * b)
        return a + b;
    const double scale = a > 1.0 ? 0x1p-600 : 0x1p600;
    return corrected_root(scale * a, scale * b) / scale;
}

/// The length of (x, y). std::hypot gives other bits on other processors and C libraries: where
/// there is a fused multiply-add, glibc takes another path on ARM, though not on x86. This has the
/// bits of glibc 2.36 on x86, with which all recorded hashes were made, wherever nothing is
/// contracted (CMakeLists.txt).
inline double hypotenuse(double x, double y) {
    const double one = std::abs(x), other = std::abs(y);
    const double a = one < other ? other : one, b = one < other ? one : other;
    if (!(a <= 0x1p511 && b >= 0x1p-459)) [[unlikely]] // NaN, too
        return far_hypotenuse(a, b);
    return b <= 0x1p-54 * a ? a + b : corrected_root(a, b);
}

} // namespace listric::dem
