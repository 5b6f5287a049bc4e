#pragma once

#include <cstdint>
#include <vector>

#include "hal/files/recording/recording.h"

namespace baraka::commands {

/// How the instants of a recorded topic can be described, as the keys of `topics:` do.
struct RecordedRhythm {
  enum class Kind : std::uint8_t {
    kFew,       ///< Two samples or fewer, or less than one in 1000 s: there is no rate.
    kPeriodic,  ///< `rate`, with `jitter`
    kPoisson,   ///< `poisson`
    kBursts,    ///< `bursts`
  };
  Kind kind = Kind::kFew;
  double mean_rate = 0;       ///< Hz, from the first sample to the last; 0: one instant only.
  double gap_mean = 0;        ///< s
  double gap_sd = 0;          ///< s, of the gaps between samples.
  double rate = 0;            ///< Hz: of samples, or of bursts.
  double jitter = 0;          ///< s: half the width of the uniform deviation with these gaps.
  std::uint32_t samples = 0;  ///< Of a burst, rounded mean.
  double spacing = 0;         ///< s, median within a burst.
};

/// Bursts: gaps below a tenth of the mean make at least three groups, of two samples or more on
/// average, and the gaps' standard deviation exceeds their mean. Otherwise periodic: at least 70 %
/// of the gaps are within half of their median and one and a half. Otherwise Poisson.
/// @param samples  in order of time.
RecordedRhythm rhythm_of(const std::vector<hal::files::recording::RecordedSample>& samples);

/// Serialised sizes of a topic, octets.
struct RecordedSizes {
  std::uint32_t least = 0, median = 0, most = 0;
  std::uint64_t sum = 0;
  /// To be used in turn: one size, the cycle of up to eight sizes that the topic has, or ten sizes
  /// that each stand for a tenth of the samples: their means. Then sizes of one rank do not follow
  /// each other.
  std::vector<std::uint32_t> in_turn;
};
/// @pre there is at least one sample.
RecordedSizes sizes_of(const std::vector<hal::files::recording::RecordedSample>& samples);

}  // namespace baraka::commands
