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

/// What a player of `topics` was told to write, and did.
struct WriterPlan {
  hal::Time begin{};          ///< Of publication.
  std::uint64_t written = 0;  ///< Samples, in the whole run.
  /// Samples that were due; nullopt: their number is random.
  std::optional<std::uint64_t> due{};
};

/// All samples from one writer to one agent, in the order in which they were sent.
struct SamplePair {
  std::string topic, writer, reader;  ///< Of agents: their names.
  std::vector<SampleFate> samples{};
  std::optional<WriterPlan> plan{};  ///< If the writer is a player of `topics`.
};

/// Samples that a writer wrote before it knew the reader; they are not in the record.
inline constexpr const char* kUndiscovered = "before discovery";
/// Samples that a writer could not write in time, because an earlier write waited for room.
inline constexpr const char* kUnwritten = "not written in time";
/// Samples that were neither delivered nor lost at the end of the run, though sent before kGrace.
inline constexpr const char* kUnderWay = "still under way";
/// Time before the end of the window in which a sample may be under way.
inline constexpr hal::Duration kGrace = std::chrono::seconds{1};

/// Counts and times of the samples of some pairs in a window.
struct SampleMeasure {
  std::uint64_t pairs = 0;   ///< Writers and agents with a reader of their topic.
  std::uint64_t silent = 0;  ///< Pairs among these of which no sample arrived in the whole run.
  std::uint64_t samples = 0, delivered = 0, first_try = 0, repaired = 0;
  std::uint64_t under_way = 0;  ///< Left out of `samples`: sent within kGrace of the end.
  /// By verdict and place: "queue full at ap"; and the kinds below.
  std::map<std::string, std::uint64_t> lost{};
  std::vector<double> latencies{};  ///< s, ascending.
  std::optional<double> age95{};    ///< s; nullopt: there is no pair.
  /// s, when the last pair had its first sample; nullopt: there is no pair, or a silent one.
  std::optional<double> discovered{};

  /// nullopt: nothing was sent in the window.
  std::optional<double> delivered_share() const;
};

/// Samples of the last kGrace that are neither delivered nor lost at the end of the run are left
/// out. Those of a player that are not in the record count as lost: what it had to write and did
/// not, spread over its time, and what it wrote before it knew the reader, spread over that time.
///
/// The age of a pair is the time since the newest sample that its reader has was sent, and the time
/// since the start of the run before the first one. `age95` is the age that is not exceeded in 95 %
/// of the window, over all pairs.
SampleMeasure measure(const std::vector<const SamplePair*>& pairs, const Window& window);

}  // namespace results::fleet
