#pragma once

namespace hal::math {

/// Elementary functions that give the same bits on every processor. glibc's choose another code
/// path on processors with fused multiply-add and then differ in the last bit, so nothing in the
/// simulation calls <cmath>'s. These are SLEEF's deterministic scalar versions (N. Shibata and
/// F. Petrogalli, "SLEEF: A Portable Vectorized Library of C Standard Mathematical Functions",
/// IEEE TPDS, 2020): error <= 1.0 ulp unless stated. std::sqrt, std::abs, std::floor and
/// std::fma-free arithmetic are exact by IEEE 754 and may be used directly.

inline constexpr double kPi = 3.14159265358979323846;

double sin(double radians);
double cos(double radians);
double tan(double radians);
double acos(double x);
double atan2(double y, double x);  ///< rad, (-pi, pi].
double exp(double x);
double log(double x);
double log10(double x);
double pow(double base, double exponent);
double hypot(double x, double y);
double erfc(double x);  ///< error <= 1.5 ulp.

/// The same angle in (-pi, pi]. @pre |radians| < 1e9.
double wrap_angle(double radians);

}  // namespace hal::math
