#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/types/time.h"

namespace results::fleet {

/// The time in which samples count: those sent from `from` on, until `until`.
struct Window {
  hal::Time from{}, until{};
  double seconds() const { return hal::to_seconds(until - from); }
};

/// One sample on its way to one agent.
struct SampleFate {
  hal::Time entered{};              ///< When its first packet left the sender's interface.
  std::optional<hal::Time> left{};  ///< When it was complete at the receiver's; nullopt: not.
  bool is_repaired = false;
  std::string verdict{};  ///< Why it was lost; "": delivered, or under way at the end.
  std::string lost_at{};  ///< The agent at which it was lost; "": not known.
};

/// All samples from one writer to one agent, in the order in which they were sent.
struct SamplePair {
  std::string topic, writer, reader;  ///< Of agents: their names.
  std::vector<SampleFate> samples{};
  /// Samples per second that the writer writes, if it is known: of a player of `topics`.
  std::optional<double> rate{};
};

/// Samples that a writer of known rate wrote in the window before it knew the reader; they are not
/// in the record.
inline constexpr const char* kUndiscovered = "before discovery";

/// Counts and times of the samples of some pairs in a window.
struct SampleMeasure {
  std::uint64_t pairs = 0;   ///< Writers and agents with a reader of their topic.
  std::uint64_t silent = 0;  ///< Pairs among these of which no sample arrived in the whole run.
  std::uint64_t samples = 0, delivered = 0, first_try = 0, repaired = 0;
  /// By verdict and place: "queue full at ap"; and kUndiscovered.
  std::map<std::string, std::uint64_t> lost{};
  std::vector<double> latencies{};  ///< s, ascending.
  std::optional<double> age95{};    ///< s; nullopt: there is no pair.
  /// s, when the last pair had its first sample; nullopt: there is no pair, or a silent one.
  std::optional<double> discovered{};

  /// nullopt: nothing was sent in the window.
  std::optional<double> delivered_share() const;
  std::optional<double> latency(double p) const;  ///< s; nullopt: nothing was delivered.
};

/// Samples that are neither delivered nor lost at the end of the run are left out.
///
/// The age of a pair is the time since the newest sample that its reader has was sent, and the time
/// since the start of the run before the first one. `age95` is the age that is not exceeded in 95 %
/// of the window, over all pairs.
SampleMeasure measure(const std::vector<const SamplePair*>& pairs, const Window& window);

}  // namespace results::fleet
