#include "sim/radio/mac/flow_hash.h"

#include <span>
#include <utility>

namespace sim::radio {
namespace {

using Packet = std::span<const std::uint8_t>;

constexpr Ethertype kIpv4 = 0x0800, kIpv6 = 0x86dd;
constexpr std::size_t kIpv4Header = 20, kIpv6Header = 40, kPorts = 4;
constexpr std::uint8_t kTcp = 6, kUdp = 17, kDccp = 33, kSctp = 132, kUdpLite = 136;

/// SplitMix64's finaliser (as in hal::RandomStream) over what has come so far.
class FlowMixer {
 public:
  explicit FlowMixer(std::uint64_t seed) : state_(seed) {}

  void add(std::uint64_t value) {
    std::uint64_t x = (state_ ^ value) + 0x9e3779b97f4a7c15ULL;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    state_ = x ^ (x >> 31);
  }
  void add(Packet bytes) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      value = value << 8 | bytes[i];
      if (i % 8 == 7) add(std::exchange(value, 0));
    }
    add(value);
  }
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_;
};

bool has_ports(std::uint8_t protocol) {
  return protocol == kTcp || protocol == kUdp || protocol == kDccp || protocol == kSctp ||
         protocol == kUdpLite;
}

void add_ports(FlowMixer& mixer, Packet packet, std::size_t at, std::uint8_t protocol) {
  mixer.add(protocol);
  if (has_ports(protocol) && packet.size() >= at + kPorts) mixer.add(packet.subspan(at, kPorts));
}

/// @return false: not a whole IPv4 header (IETF RFC 791).
bool add_ipv4(FlowMixer& mixer, Packet packet) {
  if (packet.size() < kIpv4Header) return false;
  mixer.add(packet.subspan(12, 8));
  const std::size_t header = std::size_t{4} * (packet[0] & 0x0fU);
  const bool is_fragment = (packet[6] & 0x3fU) != 0 || packet[7] != 0;  // MF, or an offset
  add_ports(mixer, is_fragment ? Packet{} : packet, header, packet[9]);
  return true;
}

/// Extension headers count as the protocol. @return false: not a whole header (IETF RFC 8200).
bool add_ipv6(FlowMixer& mixer, Packet packet) {
  if (packet.size() < kIpv6Header) return false;
  mixer.add(packet.subspan(8, 32));
  add_ports(mixer, packet, kIpv6Header, packet[6]);
  return true;
}

}  // namespace

std::uint64_t flow_hash(const WaitingMsdu& msdu, std::uint64_t seed) {
  FlowMixer mixer(seed);
  const MacRequest& request = msdu.request;
  const bool is_ip = (request.ethertype == kIpv4 && add_ipv4(mixer, *request.payload)) ||
                     (request.ethertype == kIpv6 && add_ipv6(mixer, *request.payload));
  if (!is_ip) {
    mixer.add(msdu.source.value);
    mixer.add(request.destination.value);
    mixer.add(request.ethertype);
  }
  return mixer.value();
}

}  // namespace sim::radio
