#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "hal/types/time.h"
#include "hal/types/topic_qos.h"

namespace programs::topics {

/// Octets of a serialised sample that are not its content: the encapsulation header (OMG DDSI-RTPS
/// 2.5, 10.2) and the length of the sequence (OMG DDS-XTypes 1.3, 7.4.3.5).
inline constexpr std::uint32_t kLeastSize = 8;

/// Sizes that are used in turn, from the first one on. [byte], serialised.
struct SizeCycle {
  std::vector<std::uint32_t> sizes;
};

/// Independent sizes, uniform over `from` .. `to`. [byte], serialised.
struct UniformSizes {
  std::uint32_t from = 0, to = 0;
};

/// Sample i at (phase + i) / rate, with a phase drawn once from [0, 1), and an own deviation of
/// each sample, uniform over -jitter .. jitter.
struct Periodic {
  double rate = 1;  ///< Hz.
  hal::Duration jitter{};
};

/// Independent gaps, exponential with mean 1 / rate.
struct Poisson {
  double rate = 1;  ///< Hz.
};

/// Bursts at the times of Periodic without jitter, each of `samples` samples, `spacing` apart.
struct Bursts {
  double rate = 1;  ///< Of bursts, Hz.
  std::uint32_t samples = 1;
  hal::Duration spacing{};
};

/// Samples at given times after a shift that all recorded topics of the plan have in common, and
/// one of their participant's.
struct Recorded {
  struct Sample {
    hal::Duration at{};
    std::uint32_t bytes = 0;  ///< Serialised.
  };
  std::vector<Sample> samples;   ///< In order of time.
  hal::Duration repeat_after{};  ///< From one beginning to the next; 0: it is played once.
  /// Recordings of participants other than 0 begin later by a share of this, drawn for each.
  hal::Duration spread{};
};

/// A topic that the participant writes.
struct WrittenTopic {
  std::string name;
  hal::TopicQos qos;
  std::variant<SizeCycle, UniformSizes> sizes;  ///< Not of a recording.
  std::variant<Periodic, Poisson, Bursts, Recorded> rhythm;
  std::uint32_t participant = 0;  ///< Which of the plan's participants writes it.
};

/// A topic that the participant reads.
struct ReadTopic {
  std::string name;
  hal::TopicQos qos;
  std::uint32_t participant = 0;  ///< Which of the plan's participants reads it.
};

/// UDP datagrams that are not RTPS, each to all of the addresses.
struct SentFlow {
  std::uint16_t port = 0;
  std::vector<std::string> to;  ///< IPv4: "10.77.0.3".
  Recorded datagrams;           ///< Their `bytes` are of UDP's payload.
};

/// What the participants of one agent write and read. Each is a process of its own.
struct Plan {
  std::string name;  ///< Of all participants.
  std::uint32_t domain = 0;
  std::uint64_t seed = 0;
  hal::Duration begin{};          ///< From the program's start until publication begins.
  std::filesystem::path journal;  ///< File to be written at the end.
  std::vector<WrittenTopic> writes;
  std::vector<ReadTopic> reads;
  std::vector<SentFlow> flows{};       ///< Sent beside DDS.
  std::vector<std::uint16_t> ports{};  ///< Of UDP, on which others' flows are received.
};

/// The numbers of the participants in a plan, ascending; at least one.
std::vector<std::uint32_t> participants_of(const Plan& plan);

/// What one participant of a plan writes and reads; the first one has the flows, too.
Plan part_of(const Plan& plan, std::uint32_t participant);

/// The plan as JSON; parsed() gives the same plan.
std::string json_text(const Plan& plan);

/// @throws std::runtime_error  what is wrong with the text.
Plan parsed(const std::string& text);

/// Reads a plan from a file. @throws std::runtime_error  with the path.
Plan read_plan(const std::filesystem::path& path);

}  // namespace programs::topics
