#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <vector>

#include "hal/rtps/endpoint.h"
#include "hal/types/agent_id.h"
#include "sim/air/air_kind.h"
#include "sim/air/endpoints.h"
#include "sim/air/ip_packet.h"

namespace sim::air {

/// A submessage of a datagram; octets are those of the payload of UDP.
struct DatagramPart {
  std::uint32_t begin = 0, end = 0;
  AirKind kind{};
  EndpointIndex writer = 0;    ///< Its writer; of ACKNACK and NACK_FRAG, the writer addressed.
  EndpointIndex told = 0;      ///< SEDP: the endpoint that it announces.
  hal::rtps::GuidPrefix to{};  ///< Of an INFO_DST before it; zero: everyone.
  std::int64_t sequence_number = 0;  ///< User's DATA and DATA_FRAG; 0: none.
  std::uint32_t first_fragment = 1, fragments = 1, all_fragments = 1;  ///< Of the sample.
  std::uint32_t sample_size = 0;                                       ///< Octets, serialised.

  bool has_sample() const { return sequence_number > 0; }
};

/// A datagram of UDP, as far as its fragments were seen.
struct Datagram {
  std::uint64_t serial = 0;  ///< From 1 on, in the order in which they were sent.
  hal::AgentId source;
  std::uint16_t port = 0;   ///< service_port()
  std::uint32_t size = 0;   ///< Octets of the payload of UDP.
  std::uint32_t known = 0;  ///< So many of them from the first on.
  /// As many as `size`, those not known 0; gone once all were read.
  std::vector<std::byte> octets{};
  std::vector<DatagramPart> parts{};
  bool is_rtps = false;

  bool is_whole() const { return known == size; }

  /// Where the walk over the submessages stands.
  struct {
    std::uint32_t next = 0;
    hal::rtps::GuidPrefix source{}, destination{};
  } walk{};
};

/// Position of a packet's payload in its datagram; null: unknown, or not UDP.
struct DatagramPlace {
  std::shared_ptr<Datagram> datagram{};
  std::uint32_t begin = 0, end = 0;  ///< Octets of the payload of UDP.
};

/// Reassembles datagrams of UDP from the packets that senders write to their interfaces, which are
/// in order: the first fragment comes first. The last kMost unfinished datagrams are kept.
class Datagrams {
 public:
  static constexpr std::size_t kMost = 256;

  /// @pre the packet is of UDP.
  DatagramPlace add(const IpPacket& packet, hal::AgentId source);

 private:
  DatagramPlace begin(const IpPacket& packet, hal::AgentId source);
  DatagramPlace go_on(const IpPacket& packet);

  std::map<FragmentKey, std::shared_ptr<Datagram>> unfinished_;
  std::deque<FragmentKey> order_;  ///< In which they came; some may be finished.
  std::uint64_t serial_ = 0;
};

}  // namespace sim::air
