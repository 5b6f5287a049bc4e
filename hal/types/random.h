#pragma once

#include <cstdint>
#include <string_view>

namespace hal {

/// A stream of random numbers that depends only on the seed of the run and on its name, e.g.
/// "m3/backoff". Each agent and purpose has its own, so adding one does not change the others. The
/// distributions are computed here because std::uniform_int_distribution and its like give
/// different numbers on different standard libraries.
/// Generator: SplitMix64 (Steele, Lea, Flood, "Fast Splittable Pseudorandom Number Generators",
/// OOPSLA 2014), started at the FNV-1a hash of the name mixed with the seed.
class RandomStream {
 public:
  /// @param run_seed  seed of the run.   @param name  identifies the stream within the run.
  RandomStream(std::uint64_t run_seed, std::string_view name);

  /// 64 random bits.
  std::uint64_t next();

  /// Uniform over 0 .. bound-1. @pre bound > 0. D. Lemire, "Fast Random Integer Generation in an
  /// Interval", 2019; unbiased.
  std::uint32_t below(std::uint32_t bound);

  /// Uniform over [0, 1), 53 random bits.
  double uniform();

  /// Normal deviate, mean 0, standard deviation 1: Marsaglia's polar method (1964).
  double normal();

 private:
  std::uint64_t state_;
};

}  // namespace hal
