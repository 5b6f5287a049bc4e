#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hal/types/time.h"
#include "hal/types/topic_qos.h"

namespace hal::files::recording {

/// When something was published or sent, and its size.
struct RecordedSample {
  Duration at{};            ///< Since the recording's first sample.
  std::uint32_t bytes = 0;  ///< Serialised: with the CDR encapsulation header of 4 bytes.
};

/// A topic of a recording, or a flow of UDP that is not RTPS.
struct RecordedTopic {
  std::string name;             ///< As on DDS: "rt/scan" for the topic /scan of ROS 2.
  std::string type;             ///< "sensor_msgs/msg/LaserScan"; "" if the file does not tell.
  std::optional<TopicQos> qos;  ///< Of its writers, as offered; nullopt: the file does not tell.
  std::vector<RecordedSample> samples;  ///< In order of time.
  /// Which of the recording's participants of DDS writes it, and which reads it; of several, the
  /// one with the least GUID, of writers among those that wrote samples. Numbers without gaps from
  /// 0 on; nullopt: the file does not tell.
  std::optional<std::uint32_t> writer{}, reader{};
};

/// A flow of UDP datagrams without RTPS, by destination port.
struct RecordedFlow {
  std::uint16_t port = 0;
  std::vector<RecordedSample> datagrams;  ///< `bytes`: of the UDP payload.
};

/// What a file with recorded traffic holds.
struct Recording {
  Duration length{};  ///< From the first sample to the last.
  std::vector<RecordedTopic> topics;
  std::vector<RecordedFlow> flows{};  ///< Of a pcap or pcapng only.
  /// What the reader must know of the numbers, as lines: what was left out, what is not told.
  std::vector<std::string> notes{};
};

/// Reads an MCAP file, a rosbag2 (its folder, its metadata.yaml or a .db3), a pcap or a pcapng.
/// @throws std::runtime_error  with the path, the byte or row, and what is wrong there.
Recording read_recording(const std::filesystem::path& path);

}  // namespace hal::files::recording
