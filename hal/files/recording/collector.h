#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/files/recording/offered_qos.h"
#include "hal/files/recording/recording.h"

namespace hal::files::recording {

/// Samples beyond this number are refused: a file that was made to exhaust its reader.
inline constexpr std::size_t kMostSamples = 50'000'000;

/// Name on DDS of a topic of ROS 2: "rt/scan" of "/scan".
std::string dds_name(std::string_view topic);

/// Gathers what a file holds, in any order of time.
class Collector {
 public:
  /// Adds a topic, or finds it by its name.
  /// @param offered  nullopt: not told. Where writers of a topic differ, the first one counts, but
  ///   reliable and transient local win, as a reader of all of them would need them.
  /// @return the number for add().
  std::size_t topic(std::string_view name, std::string_view type,
                    const std::optional<OfferedQos>& offered);

  /// The participants that write and read a topic, unless they are known already.
  void participants(std::size_t topic, std::optional<std::uint32_t> writer,
                    std::optional<std::uint32_t> reader);

  /// @param at  nanoseconds since any epoch.
  /// @throws std::runtime_error  too many samples, without the place.
  void add(std::size_t topic, std::int64_t at, std::uint32_t bytes);
  void add_datagram(std::uint16_t port, std::int64_t at, std::uint32_t bytes);

  void note(std::string line) { notes_.push_back(std::move(line)); }
  std::size_t samples() const { return samples_; }

  /// The recording: samples in order of time, which begins with the first one.
  Recording finish();

 private:
  struct Instant {
    std::int64_t at = 0;
    std::uint32_t bytes = 0;
  };
  struct Topic {
    RecordedTopic told;
    std::vector<Instant> instants;
  };
  void count();

  std::map<std::string, std::size_t, std::less<>> numbers_;
  std::vector<Topic> topics_;
  std::map<std::uint16_t, std::vector<Instant>> flows_;
  std::vector<std::string> notes_;
  std::size_t samples_ = 0;
  std::size_t without_depth_ = 0;  ///< Topics.
};

}  // namespace hal::files::recording
