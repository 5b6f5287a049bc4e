#include "hal/types/math.h"

#include <sleef.h>

#include <cmath>

namespace hal::math {

double sin(double radians) { return Sleef_cinz_sind1_u10purec(radians); }
double cos(double radians) { return Sleef_cinz_cosd1_u10purec(radians); }
double tan(double radians) { return Sleef_cinz_tand1_u10purec(radians); }
double acos(double x) { return Sleef_cinz_acosd1_u10purec(x); }
double atan2(double y, double x) { return Sleef_cinz_atan2d1_u10purec(y, x); }
double exp(double x) { return Sleef_cinz_expd1_u10purec(x); }
double log(double x) { return Sleef_cinz_logd1_u10purec(x); }
double log10(double x) { return Sleef_cinz_log10d1_u10purec(x); }
double pow(double base, double exponent) { return Sleef_cinz_powd1_u10purec(base, exponent); }
double hypot(double x, double y) { return Sleef_cinz_hypotd1_u05purec(x, y); }
double erfc(double x) { return Sleef_cinz_erfcd1_u15purec(x); }

double wrap_angle(double radians) {
  const double turns = std::ceil((radians - kPi) / (2 * kPi));
  return radians - turns * 2 * kPi;
}

}  // namespace hal::math
