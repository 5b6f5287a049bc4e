#include "sim/air/datagram.h"

#include <algorithm>

namespace sim::air {
namespace {

constexpr std::uint32_t kUdpHeader = 8;

}  // namespace

DatagramPlace Datagrams::add(const IpPacket& packet, hal::AgentId source) {
  return packet.offset == 0 ? begin(packet, source) : go_on(packet);
}

DatagramPlace Datagrams::begin(const IpPacket& packet, hal::AgentId source) {
  hal::rtps::Cursor cursor(packet.payload, hal::rtps::Endianness::kBig);
  const std::uint16_t from = cursor.u16(), to = cursor.u16();
  const std::uint32_t length = cursor.u16();
  cursor.take(2);  // checksum: may be left to offloading
  const bool fits = length >= kUdpHeader && (packet.more || length <= packet.payload.size());
  if (cursor.is_short() || !fits) return {};
  auto datagram = std::make_shared<Datagram>();
  datagram->serial = ++serial_;
  datagram->source = source;
  datagram->port = service_port(from, to);
  datagram->size = length - kUdpHeader;
  const Octets payload = cursor.take(cursor.left());
  datagram->known = std::min(static_cast<std::uint32_t>(payload.size()), datagram->size);
  datagram->octets.resize(datagram->size);
  std::ranges::copy(payload.first(datagram->known), datagram->octets.begin());
  if (packet.more) {
    unfinished_[packet.key] = datagram;  // an earlier datagram with this identification is over
    order_.push_back(packet.key);
    if (order_.size() > kMost) {
      unfinished_.erase(order_.front());
      order_.pop_front();
    }
  }
  return {datagram, 0, datagram->known};
}

DatagramPlace Datagrams::go_on(const IpPacket& packet) {
  const auto found = unfinished_.find(packet.key);
  if (found == unfinished_.end() || packet.offset < kUdpHeader) return {};
  const std::shared_ptr<Datagram> datagram = found->second;
  const std::uint32_t begin = packet.offset - kUdpHeader;
  const auto end = static_cast<std::uint32_t>(begin + packet.payload.size());
  if (end > datagram->size) return {};
  if (begin <= datagram->known && !datagram->octets.empty()) {
    std::ranges::copy(packet.payload, datagram->octets.begin() + begin);
    datagram->known = std::max(datagram->known, end);
  }
  if (!packet.more) unfinished_.erase(found);
  return {datagram, begin, end};
}

}  // namespace sim::air
