#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "hal/files/recording/collector.h"
#include "hal/rtps/data.h"
#include "hal/rtps/endpoint.h"
#include "hal/rtps/ip_packet.h"

namespace hal::files::recording {

/// Name of a type of ROS 2 by the name that it has on DDS: "sensor_msgs/msg/LaserScan" of
/// "sensor_msgs::msg::dds_::LaserScan_"; other names unchanged.
std::string ros_type(std::string_view dds_type);

/// The samples in RTPS messages, by writer, each once: a sample is known by its writer's GUID and
/// sequence number, so the copies for several readers and repetitions are left out, and one in
/// fragments counts when the first of them is seen. Topics, types and QoS are those that SEDP
/// announces anywhere in the capture.
class RtpsTraffic {
 public:
  /// @param at  ns  @param from  its sender.  @return false: the datagram is not RTPS.
  bool read(std::int64_t at, const rtps::IpAddress& from, rtps::Octets datagram);

  /// Adds what was read to a recording, and notes of it: also from which address each topic came,
  /// if there are several.
  void finish(Collector& into) const;

 private:
  struct Sample {
    std::int64_t at = 0;
    std::uint32_t bytes = 0;
  };
  struct Writer {
    std::string topic;  ///< "": not announced.
    std::string type;
    OfferedQos offered;
    rtps::IpAddress address{};               ///< Of its first sample.
    std::map<std::int64_t, Sample> samples;  ///< By sequence number.
  };

  /// The sender of a submessage.
  struct Sender {
    rtps::IpAddress address;
    rtps::GuidPrefix participant;
  };
  void read_data(std::int64_t at, const rtps::Submessage& one, const Sender& sender);
  void tell_participants(Collector& into) const;
  void note_addresses(Collector& into) const;
  void learn(const rtps::Data& data);
  void learn_reader(const rtps::Data& data);
  std::map<rtps::GuidPrefix, std::uint32_t> numbers() const;

  std::map<rtps::Guid, Writer> writers_;
  std::map<std::string, rtps::GuidPrefix> readers_;  ///< By topic: the least participant.
  std::uint64_t datagrams_ = 0, octets_ = 0, malformed_ = 0, encrypted_ = 0;
  std::size_t samples_ = 0;
};

}  // namespace hal::files::recording
