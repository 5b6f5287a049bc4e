#pragma once

#include <cstdint>

#include "results/report/quantiles.h"

namespace results::report::paper {

/// How much a comparison with a figure of the paper proves.
enum class Basis : std::uint8_t {
  kNone,        ///< The paper has no such figure.
  kStated,      ///< The paper's number; none of our settings was chosen to match it.
  kInferred,    ///< The paper's number, from which we inferred radio settings it does not state.
  kCalibrated,  ///< Our settings were chosen so that this very figure comes near the paper's.
};

/// "", "stated", "inferred", "calibrated".
constexpr const char* name_of(Basis basis) {
  switch (basis) {
    case Basis::kStated:
      return "stated";
    case Basis::kInferred:
      return "inferred";
    case Basis::kCalibrated:
      return "calibrated";
    case Basis::kNone:
      break;
  }
  return "";
}

/// Explanation of the three words, printed below tables.
inline constexpr const char* kBasisMeaning =
    "stated: the paper gives this number, and none of our settings was chosen to match it. "
    "inferred: the paper gives this number, but not the bit rate, the use of RTS/CTS and the size "
    "of packets without a length; of eight MAC settings that we tried, we use the one that "
    "reproduces both minima. calibrated: the jitter of first ants, keep-alive and its rule, the "
    "grid, the range and the mote that calls were chosen so that this figure comes near the "
    "paper's, so agreement is no evidence here.";

/// Why our maxima are lower than the paper's; printed below tables.
inline constexpr const char* kNoTail =
    "The paper's longest times are several seconds: route discoveries take up to 10 s, two "
    "periods of the retry. In the shipped case study a search almost never loses all its ants, "
    "because the jitter keeps the copies of a flood apart, there is no other traffic, and a link "
    "is either perfect or absent. So the retry, which would take seconds, is not needed. Two "
    "changes bring the tail back: losing 20 % or more of the frames; and, without any loss, a "
    "jitter of 1 ms, with which the copies of a flood collide, but which moves the median and the "
    "third quartile of the discoveries away from the paper's. Hello beacons and background "
    "traffic do not bring it back. docs/case_study_tail.md describes the experiment, "
    "docs/sensitivity.md the effect of other values.";

/// What the paper reports of its case study: T. H. Labella, I. Dietrich, F. Dressler, "Hybrid
/// simulation of Sensor and Actor Networks with BARAKA", 2009, figures 11 to 14.

/// Route discovery, s.
inline constexpr Quantiles kDiscovery{
    .min = 0.96e-3, .q1 = 2.11e-3, .median = 10.27e-3, .q3 = 60.72e-3, .max = 10.02};
/// End-to-end delay, s.
inline constexpr Quantiles kDelay{
    .min = 0.7e-3, .q1 = 0.7e-3, .median = 2.52e-3, .q3 = 8.7e-3, .max = 5.66};
/// Packets received over ten runs by the node that received most and the one that received least.
inline constexpr double kMostPackets = 4272;
inline constexpr double kLeastPackets = 1848;
inline constexpr int kRuns = 10;

}  // namespace results::report::paper
