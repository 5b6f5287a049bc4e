#include "hal/types/random.h"

#include <cmath>

#include "hal/types/check.h"
#include "hal/types/math.h"

namespace hal {
namespace {

constexpr std::uint64_t kFnvOffset = 0xcbf29ce484222325u;
constexpr std::uint64_t kFnvPrime = 0x100000001b3u;

/// Finaliser of SplitMix64: every bit of z affects every bit of the result.
std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

}  // namespace

RandomStream::RandomStream(std::uint64_t run_seed, std::string_view name) : state_(kFnvOffset) {
  for (const char c : name) state_ = (state_ ^ static_cast<unsigned char>(c)) * kFnvPrime;
  // Neighbouring seeds must not give shifted copies of one sequence: mix before combining.
  state_ = mix(state_ ^ mix(run_seed));
}

std::uint64_t RandomStream::next() { return mix(state_ += 0x9e3779b97f4a7c15u); }

std::uint32_t RandomStream::below(std::uint32_t bound) {
  BARAKA_CHECK(bound > 0);
  std::uint64_t product = (next() >> 32) * bound;
  const std::uint32_t threshold = (0u - bound) % bound;
  while (static_cast<std::uint32_t>(product) < threshold) product = (next() >> 32) * bound;
  return static_cast<std::uint32_t>(product >> 32);
}

double RandomStream::uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }

double RandomStream::normal() {
  while (true) {
    const double u = 2 * uniform() - 1;
    const double v = 2 * uniform() - 1;
    const double s = u * u + v * v;
    if (s > 0 && s < 1) return u * std::sqrt(-2 * math::log(s) / s);
  }
}

}  // namespace hal
