#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "hal/types/math.h"
#include "sim/radio/phy/ofdm_error_model.h"

namespace sim::radio::test {
namespace {

/// The code with constraint length 7 and generators 133 and 171 (IEEE Std 802.11-2020, 17.3.5.6 and
/// 19.3.11.6), punctured: which of the two outputs of each step are sent.
struct Punctured {
  CodeRate rate;
  std::vector<std::array<int, 2>> sent;
  int first, step;  ///< Distances of the coefficients.
};

constexpr std::size_t kStates = 64;
constexpr int kMostDistance = 28;

/// Numbers of paths that left the zero state and are in one state, and of their wrong bits.
struct Paths {
  double count = 0, bits = 0;
};
using Front = std::array<std::array<Paths, kMostDistance + 1>, kStates>;

/// Output bits of a step from a state with an input bit: weight as punctured.
int weight(const Punctured& code, std::size_t phase, unsigned window) {
  const int a = std::popcount(window & 0b1011011U) % 2, b = std::popcount(window & 0b1111001U) % 2;
  return a * code.sent[phase][0] + b * code.sent[phase][1];
}

/// Moves all paths by a step; those that return to the zero state end there and are counted.
Front stepped(const Punctured& code, std::size_t phase, const Front& front,
              std::array<double, kMostDistance + 1>& bits) {
  Front next{};
  for (std::size_t state = 1; state < kStates; ++state) {
    for (const unsigned input : {0U, 1U}) {
      const unsigned window = input << 6 | static_cast<unsigned>(state);
      const int more = weight(code, phase, window);
      for (int d = 0; d + more <= kMostDistance; ++d) {
        const Paths& paths = front[state][static_cast<std::size_t>(d)];
        if (paths.count == 0) continue;
        const auto to = static_cast<std::size_t>(d + more);
        const double wrong = paths.bits + input * paths.count;
        if (window >> 1 == 0) {
          bits[to] += wrong;
        } else {
          next[window >> 1][to].count += paths.count;
          next[window >> 1][to].bits += wrong;
        }
      }
    }
  }
  return next;
}

/// Wrong information bits of all paths of each distance, over all phases in which they may leave.
std::array<double, kMostDistance + 1> wrong_bits(const Punctured& code) {
  std::array<double, kMostDistance + 1> bits{};
  const std::size_t period = code.sent.size();
  for (std::size_t start = 0; start < period; ++start) {
    Front front{};
    constexpr unsigned kLeaves = 1U << 6;
    front[kLeaves >> 1][static_cast<std::size_t>(weight(code, start, kLeaves))] = {1, 1};
    for (std::size_t step = 1; step < 400; ++step) {
      front = stepped(code, (start + step) % period, front, bits);
    }
  }
  return bits;
}

void PrintTo(const Punctured& code, std::ostream* out) { *out << code.sent.size() << " inputs"; }

class CodeWeights : public testing::TestWithParam<Punctured> {};

// The union bound from the weights counted here, by enumeration of the trellis, is that of the
// model. Within 1e-3: from the sixth coefficient on, the printed ones of the punctured codes are up
// to 0.3 % larger.
TEST_P(CodeWeights, AreThoseOfTheTrellis) {
  const Punctured& code = GetParam();
  const auto bits = wrong_bits(code);
  const int last = code.first + 9 * code.step;
  const auto period = static_cast<double>(code.sent.size());
  for (const double sinr : {4.0, 5.0, 6.0}) {
    const double raw = 0.5 * hal::math::erfc(std::sqrt(sinr));
    const double d = std::sqrt(4 * raw * (1 - raw));
    double sum = 0;
    for (int i = 0; i <= last; ++i) sum += bits[static_cast<std::size_t>(i)] * std::pow(d, i);
    const double one_bit = ofdm_success_probability(sinr, {Constellation::kBpsk, code.rate}, 1);
    EXPECT_NEAR(1 - one_bit, sum / (2 * period), 1e-3 * sum / (2 * period)) << sinr;
  }
}
INSTANTIATE_TEST_SUITE_P(
    Punctured, CodeWeights,
    testing::Values(Punctured{CodeRate::kHalf, {{1, 1}}, 10, 2},
                    Punctured{CodeRate::kTwoThirds, {{1, 1}, {1, 0}}, 6, 1},
                    Punctured{CodeRate::kThreeQuarters, {{1, 1}, {1, 0}, {0, 1}}, 5, 1},
                    Punctured{
                        CodeRate::kFiveSixths, {{1, 1}, {1, 0}, {0, 1}, {1, 0}, {0, 1}}, 4, 1}));

}  // namespace
}  // namespace sim::radio::test
