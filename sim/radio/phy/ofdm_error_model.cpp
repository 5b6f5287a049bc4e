#include "sim/radio/phy/ofdm_error_model.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "hal/types/check.h"
#include "hal/types/math.h"

namespace sim::radio {
namespace {

/// Bit error rate of a constellation: weight * erfc(sqrt(sinr / divisor)), for Gray-coded square
/// constellations and nearest neighbours.
struct Constellation {
  double weight;
  double divisor;
};
constexpr Constellation kBpsk{1.0 / 2, 1}, kQpsk{1.0 / 2, 2}, kQam16{3.0 / 8, 10},
    kQam64{7.0 / 24, 42};

/// Numbers of wrong information bits, summed over all wrong paths of each Hamming distance `first`,
/// `first + step`, ...
struct Code {
  int first;
  int step;
  double inputs;                  ///< Information bits per puncturing period.
  std::array<double, 10> errors;  ///< Sum over the paths of each distance.
};
constexpr Code kHalf{
    10, 2, 1, {36, 211, 1404, 11633, 77433, 502690, 3322763, 21292910, 134365911, 0}};
constexpr Code kTwoThirds{
    6, 1, 2, {3, 70, 285, 1276, 6160, 27128, 117019, 498860, 2103891, 8784123}};
constexpr Code kThreeQuarters{
    5, 1, 3, {42, 201, 1492, 10469, 62935, 379644, 2253373, 13073811, 75152755, 428005675}};

struct Coding {
  double rate;  ///< bit/s
  const Constellation& constellation;
  const Code& code;
};
/// IEEE Std 802.11-2016, table 17-4.
constexpr std::array kCodings{
    Coding{6e6, kBpsk, kHalf},        Coding{9e6, kBpsk, kThreeQuarters},
    Coding{12e6, kQpsk, kHalf},       Coding{18e6, kQpsk, kThreeQuarters},
    Coding{24e6, kQam16, kHalf},      Coding{36e6, kQam16, kThreeQuarters},
    Coding{48e6, kQam64, kTwoThirds}, Coding{54e6, kQam64, kThreeQuarters}};

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
  const Constellation& c = coding.constellation;
  return decoded_error(coding.code, c.weight * hal::math::erfc(std::sqrt(sinr / c.divisor)));
}

/// Results of bit_error(): between stations that stand still the same few ratios occur again and
/// again.
class BitErrors {
 public:
  double at(const Coding& coding, double sinr) {
    Entry& entry = entries_[place_of(sinr)];
    if (entry.coding != &coding || entry.sinr != sinr)
      entry = {&coding, sinr, bit_error(coding, sinr)};
    return entry.error;
  }

 private:
  static constexpr int kBits = 10;
  struct Entry {
    const Coding* coding = nullptr;
    double sinr = 0, error = 0;
  };
  static std::size_t place_of(double sinr) {
    constexpr std::uint64_t kMix = 0x9e37'79b9'7f4a'7c15;
    return std::bit_cast<std::uint64_t>(sinr) * kMix >> (64 - kBits);
  }

  std::array<Entry, std::size_t{1} << kBits> entries_{};
};

}  // namespace

double ofdm_success_probability(double sinr, hal::BitsPerSecond rate, double bits) {
  if (bits <= 0) return 1;
  const auto* const found = std::ranges::find(kCodings, rate.value, &Coding::rate);
  BARAKA_CHECK(found != kCodings.end());
  static thread_local BitErrors known;
  const double right = 1 - known.at(*found, sinr);
  return right >= 1 ? 1 : hal::math::pow(right, bits);
}

}  // namespace sim::radio
