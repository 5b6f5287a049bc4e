#include "sim/radio/phy/ofdm_error_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "hal/types/math.h"
#include "sim/radio/phy/known_results.h"

namespace sim::radio {
namespace {

/// Bit error rate of a constellation: weight * erfc(sqrt(sinr / divisor)), for Gray-coded square
/// constellations and nearest neighbours: of k * k points, (k - 1) / (k log2(k * k)) and
/// 2 (k * k - 1) / 3.
struct BitError {
  double weight;
  double divisor;
};
constexpr BitError bit_error_of(Constellation constellation) {
  switch (constellation) {
    case Constellation::kBpsk:
      return {1.0 / 2, 1};
    case Constellation::kQpsk:
      return {1.0 / 2, 2};
    case Constellation::kQam16:
      return {3.0 / 8, 10};
    case Constellation::kQam64:
      return {7.0 / 24, 42};
    case Constellation::kQam256:
      return {15.0 / 64, 170};
    case Constellation::kQam1024:
      break;
  }
  return {31.0 / 160, 682};
}

/// Numbers of wrong information bits, summed over all wrong paths of each Hamming distance `first`,
/// `first + step`, ...
struct Code {
  int first;
  int step;
  double inputs;                  ///< Information bits per puncturing period.
  std::array<double, 10> errors;  ///< Sum over the paths of each distance.
};
/// By CodeRate.
constexpr std::array kCodes{
    Code{10, 2, 1, {36, 211, 1404, 11633, 77433, 502690, 3322763, 21292910, 134365911, 0}},
    Code{6, 1, 2, {3, 70, 285, 1276, 6160, 27128, 117019, 498860, 2103891, 8784123}},
    Code{5, 1, 3, {42, 201, 1492, 10469, 62935, 379644, 2253373, 13073811, 75152755, 428005675}},
    Code{4,
         1,
         5,
         {92, 528, 8694, 79453, 792114, 7375573, 67884974, 610875423, 5427275376, 47664215639}}};

/// Union bound of the probability of the decoder's first error event, per information bit.
double decoded_error(const Code& code, double channel_error) {
  const double d = std::sqrt(4 * channel_error * (1 - channel_error));
  double path = 1;
  for (int i = 0; i < code.first; ++i) path *= d;
  double sum = 0;
  for (const double errors : code.errors) {
    sum += errors * path;
    for (int i = 0; i < code.step; ++i) path *= d;
  }
  return std::min(1.0, sum / (2 * code.inputs));
}

/// Probability of the decoder's first error event, per information bit.
double bit_error(const Coding& coding, double sinr) {
  const BitError c = bit_error_of(coding.constellation);
  return decoded_error(kCodes[static_cast<std::size_t>(coding.rate)],
                       c.weight * hal::math::erfc(std::sqrt(sinr / c.divisor)));
}

}  // namespace

double ofdm_success_probability(double sinr, const Coding& coding, double bits) {
  if (bits <= 0) return 1;
  static thread_local KnownResults<Coding, 10> known;
  const double right =
      1 - known.of(sinr, coding, [&coding](double ratio) { return bit_error(coding, ratio); });
  return right >= 1 ? 1 : hal::math::pow(right, bits);
}

}  // namespace sim::radio
