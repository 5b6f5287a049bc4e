#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "hal/types/time.h"
#include "hal/types/topic_qos.h"

namespace sim::scenario {

using namespace std::chrono_literals;

/// Serialised sizes, from `from` to `to`, uniform. [byte]
struct SizeRange {
  std::uint32_t from = 0, to = 0;
};
/// Serialised sizes used in turn [byte]; or a range.
using SampleSizes = std::variant<std::vector<std::uint32_t>, SizeRange>;

/// Smallest serialised sample: the encapsulation header and the length of a sequence. [byte]
inline constexpr std::uint32_t kLeastSample = 8;
/// Largest one: MaxSampleSize of Cyclone DDS 0.10, by default. [byte]
inline constexpr std::uint32_t kMostSample = 2147483647;

struct PeriodicSamples {
  double rate = 10;  ///< Hz.
  hal::Duration jitter{};
};
struct PoissonSamples {
  double rate = 10;  ///< Hz.
};
struct SampleBursts {
  double rate = 1;  ///< Of bursts, Hz.
  std::uint32_t samples = 2;
  hal::Duration spacing{};
};
using SampleRhythm = std::variant<PeriodicSamples, PoissonSamples, SampleBursts>;

/// Topics of a recording: their names, sizes and instants, and QoS unless stated here.
struct RecordedTraffic {
  std::filesystem::path from;                 ///< Absolute; empty: no recording.
  std::map<std::string, std::string> rename;  ///< New names, which may contain kAgentWord.
  bool repeats = false;                       ///< From the beginning, when it is over.
  bool has_flows = false;                     ///< Also flows of UDP that are not RTPS.
  hal::Duration spread = 0ms;                 ///< Of the beginnings of an agent's participants.
  std::optional<hal::TopicQos::Reliability> reliability;
  std::optional<hal::TopicQos::Durability> durability;
  std::optional<std::optional<std::uint32_t>> depth;
  std::optional<hal::Duration> deadline;
};

/// How an agent's topics are shared out among participants of DDS, each a process of its own.
enum class Participants : std::uint8_t {
  kAgent,     ///< One for all topics of the agent.
  kTopic,     ///< One for each topic.
  kRecorded,  ///< As in the recording; where it does not tell, as kAgent.
};

/// One item of `topics:`, which each agent of a group writes: a topic, or those of a recording.
struct TopicItem {
  std::string name;  ///< On DDS; may contain kAgentWord. Of a recording: pattern of its topics.
  SampleSizes sizes{};
  SampleRhythm rhythm{};
  hal::TopicQos qos{};
  RecordedTraffic recorded{};
  Participants participants = Participants::kAgent;
  std::vector<std::string> readers{};  ///< Names or patterns of agents; never the writer itself.
  std::string place{};                 ///< "file:line:column".

  bool is_recorded() const { return !recorded.from.empty(); }
};

enum class DdsVendor : std::uint8_t { kCycloneDds, kFastDds };

/// How the participants of a group's agents are made.
struct DdsKeys {
  DdsVendor vendor = DdsVendor::kCycloneDds;
  std::filesystem::path profile;  ///< Absolute; empty: none.
  std::uint32_t domain = 0;
  hal::Duration start = 0ns;  ///< Simulated time of the participant's start.
  hal::Duration begin = 1s;   ///< From then until publication begins.
};

}  // namespace sim::scenario
