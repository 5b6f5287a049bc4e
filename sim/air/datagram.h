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

/// A submessage of a datagram. Positions are octets in the UDP payload.
struct DatagramPart {
  std::uint32_t begin = 0, end = 0;
  AirKind kind{};
  EndpointIndex writer = 0;    ///< Its writer; for ACKNACK and NACK_FRAG, the writer addressed.
  EndpointIndex told = 0;      ///< SEDP: the endpoint that it announces.
  hal::rtps::GuidPrefix to{};  ///< Destination of a preceding INFO_DST; zero: everyone.
  std::int64_t sequence_number = 0;  ///< DATA and DATA_FRAG of programs; 0: none.
  /// Fragment numbers and count of the sample.
  std::uint32_t first_fragment = 1, fragments = 1, all_fragments = 1;
  std::uint32_t sample_size = 0;  ///< Serialised size, octets.

  bool has_sample() const { return sequence_number > 0; }
};

/// A UDP datagram, as far as its fragments have been observed.
struct Datagram {
  std::uint64_t serial = 0;  ///< Number in order of transmission, from 1.
  hal::AgentId source;
  std::uint16_t port = 0;   ///< service_port()
  std::uint32_t size = 0;   ///< Octets of the UDP payload.
  std::uint32_t known = 0;  ///< Number of leading octets that are known.
  /// Has `size` octets, the unknown ones 0; freed when all have been read.
  std::vector<std::byte> octets{};
  std::vector<DatagramPart> parts{};
  bool is_rtps = false;

  bool is_whole() const { return known == size; }

  /// Progress of the walk over the submessages.
  struct {
    std::uint32_t next = 0;
    hal::rtps::GuidPrefix source{}, destination{};
  } walk{};
};

/// Position of a packet's payload in its datagram; null if unknown or not UDP.
struct DatagramPlace {
  std::shared_ptr<Datagram> datagram{};
  std::uint32_t begin = 0, end = 0;  ///< Octets in the UDP payload.
};

/// Reassembles UDP datagrams from the packets that programs write to their interfaces. These come
/// in order: the first fragment is first. The last kMost unfinished datagrams are kept.
class Datagrams {
 public:
  static constexpr std::size_t kMost = 256;

  /// @pre the packet carries UDP.
  DatagramPlace add(const IpPacket& packet, hal::AgentId source);

 private:
  DatagramPlace begin(const IpPacket& packet, hal::AgentId source);
  DatagramPlace go_on(const IpPacket& packet);

  std::map<FragmentKey, std::shared_ptr<Datagram>> unfinished_;
  std::deque<FragmentKey> order_;  ///< In order of arrival; some may be finished.
  std::uint64_t serial_ = 0;
};

}  // namespace sim::air
