#pragma once

namespace hal::math {

/// Elementary functions that give the same bits on every processor. Those of glibc take another
/// code path on processors with fused multiply-add and then differ in the last bit, so simulation
/// code never calls the functions of <cmath>. These are SLEEF's deterministic scalar versions (N.
/// Shibata and F. Petrogalli, "SLEEF: A Portable Vectorized Library of C Standard Mathematical
/// Functions", IEEE TPDS, 2020): error <= 1.0 ulp unless stated. std::sqrt, std::abs, std::floor
/// and std::fma-free arithmetic are exact by IEEE 754 and may be used directly.

inline constexpr double kPi = 3.14159265358979323846;  ///< Half a turn, rad.

double sin(double radians);                ///< Sine.
double cos(double radians);                ///< Cosine.
double tan(double radians);                ///< Tangent.
double acos(double x);                     ///< Arc cosine of -1 .. 1: rad, 0 .. pi.
double atan2(double y, double x);          ///< Direction of (x, y): rad, (-pi, pi].
double exp(double x);                      ///< e^x.
double log(double x);                      ///< Natural logarithm.
double log10(double x);                    ///< Decimal logarithm.
double pow(double base, double exponent);  ///< base^exponent.
double hypot(double x, double y);          ///< sqrt(x^2 + y^2) without overflow in between.
double erfc(double x);                     ///< 1 - erf(x); error <= 1.5 ulp.

/// The equivalent angle in (-pi, pi], rad. @pre |radians| < 1e9.
double wrap_angle(double radians);

}  // namespace hal::math
