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
    "stated: the paper's number, and nothing of ours was chosen by it. inferred: the paper's "
    "number; bit rate, RTS/CTS and packets without length are what, of eight settings of the MAC "
    "tried, gives both minima, and the paper does not say them. calibrated: jitter of first "
    "ants, keep-alive and its rule, grid, range and the mote that calls were chosen so that this "
    "very figure comes near the paper's: agreement there is no evidence.";

/// Explanation why our maxima lie below the paper's, printed below tables.
inline constexpr const char* kNoTail =
    "The paper's longest times are seconds, its route discoveries up to 10 s: two periods of the "
    "retry. In the case study as it ships a search hardly ever loses all its ants: the jitter "
    "keeps the copies of a flood apart, nothing else is on the air, and a link is either perfect "
    "or absent. So the retry that makes seconds is not needed. Two things bring the tail back: "
    "losing 20 % or more of the frames; and, without any loss, a jitter of 1 ms, with which the "
    "copies of a flood collide, but then the median and the third quartile of the discoveries go "
    "away from the paper's. Hello beacons and background traffic do not. "
    "docs/case_study_tail.md has the experiment, docs/sensitivity.md what other values do.";

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
