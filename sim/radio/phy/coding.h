#pragma once

#include <cstdint>

namespace sim::radio {

/// Constellation of the data subcarriers; its value is the number of coded bits that one carries.
enum class Constellation : std::uint8_t {
  kBpsk = 1,
  kQpsk = 2,
  kQam16 = 4,
  kQam64 = 6,
  kQam256 = 8,
  kQam1024 = 10
};

/// Rate of the convolutional code, punctured from 1/2.
enum class CodeRate : std::uint8_t { kHalf, kTwoThirds, kThreeQuarters, kFiveSixths };

/// Information bits and coded bits of a code rate: R = information / coded.
struct CodeRatio {
  int information = 1;
  int coded = 2;
};
constexpr CodeRatio ratio_of(CodeRate rate) {
  switch (rate) {
    case CodeRate::kHalf:
      return {1, 2};
    case CodeRate::kTwoThirds:
      return {2, 3};
    case CodeRate::kThreeQuarters:
      return {3, 4};
    case CodeRate::kFiveSixths:
      break;
  }
  return {5, 6};
}

/// How bits become the subcarriers of OFDM.
struct Coding {
  Constellation constellation = Constellation::kBpsk;
  CodeRate rate = CodeRate::kHalf;
  bool operator==(const Coding&) const = default;
};

}  // namespace sim::radio
