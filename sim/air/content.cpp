#include "sim/air/content.h"

#include <algorithm>
#include <span>

namespace sim::air {
namespace {

/// This many are always kept.
constexpr std::size_t kAlwaysKept = 64;

Contents::Read only(Purpose purpose, std::uint16_t what, std::uint16_t port = 0) {
  const Piece piece{.kind = {.purpose = purpose, .what = what, .port = port}};
  return {std::make_shared<const Content>(Content{{piece}}), 0, true};
}

/// Service port of a packet with its two ports in the first four octets.
std::uint16_t port_of(const IpPacket& packet) {
  hal::rtps::Cursor cursor(packet.payload, hal::rtps::Endianness::kBig);
  const std::uint16_t from = cursor.u16(), to = cursor.u16();
  return cursor.is_short() ? std::uint16_t{0} : service_port(from, to);
}

/// The submessages of a datagram that lie at least partly in these octets.
std::vector<Piece> pieces_of(const DatagramPlace& place) {
  std::vector<Piece> pieces;
  for (const DatagramPart& part : place.datagram->parts) {
    const std::uint32_t begin = std::max(part.begin, place.begin);
    const std::uint32_t end = std::min(part.end, place.end);
    if (begin >= end) continue;
    pieces.push_back({part.kind, part.writer, end - begin, part.begin >= place.begin});
  }
  if (pieces.empty()) pieces.push_back({.kind = {.purpose = Purpose::kRtps, .what = kMalformed}});
  return pieces;
}

}  // namespace

std::size_t Content::main() const {
  const auto largest = std::ranges::max_element(pieces, {}, &Piece::octets);
  return static_cast<std::size_t>(largest - pieces.begin());
}

Contents::Read Contents::read(hal::Time at, hal::AgentId source, radio::Ethertype type,
                              const radio::Payload& payload) {
  const auto found = contents_.find(payload);
  if (found != contents_.end()) return {found->second, 0, false};
  Read read = look_into(at, source, type, std::as_bytes(std::span(*payload)));
  order_.push_back(contents_.emplace(payload, read.content).first);
  forget();
  return read;
}

void Contents::forget() {
  // Payloads that are still held go to the back, so that they do not block others. With two steps
  // for each new payload, the number of unheld ones does not exceed that of held ones.
  for (int looks = 0; looks < 2 && order_.size() > kAlwaysKept; ++looks) {
    const Map::iterator oldest = order_.front();
    order_.pop_front();
    if (oldest->first.use_count() > 1) {
      order_.push_back(oldest);
    } else {
      contents_.erase(oldest);
    }
  }
}

Contents::Read Contents::look_into(hal::Time at, hal::AgentId source, radio::Ethertype type,
                                   Octets payload) {
  if (type == kEthertypeArp) return only(Purpose::kNetwork, kArp);
  if (type == radio::kEthertypeRouting) return only(Purpose::kRouting, type);
  if (type != kEthertypeIpv4 && type != kEthertypeIpv6) return only(Purpose::kOther, type);
  const auto packet = read_ip(type, payload);
  return packet ? look_into(at, source, *packet) : only(Purpose::kNetwork, kMalformed);
}

Contents::Read Contents::look_into(hal::Time at, hal::AgentId source, const IpPacket& packet) {
  const std::uint8_t protocol = packet.key.protocol;
  if (protocol != protocol::kUdp) {
    if (packet.offset > 0) return only(Purpose::kNetwork, kFragments);
    return only(Purpose::kNetwork, protocol,
                protocol == protocol::kTcp ? port_of(packet) : std::uint16_t{0});
  }
  DatagramPlace place = datagrams_.add(packet, source);
  if (!place.datagram) return only(Purpose::kNetwork, packet.offset > 0 ? kFragments : kMalformed);
  const std::size_t before = reader_.read(at, *place.datagram);
  if (!place.datagram->is_rtps)
    return only(Purpose::kNetwork, protocol::kUdp, place.datagram->port);
  auto content = std::make_shared<Content>(Content{pieces_of(place), place});
  return {std::move(content), before, true};
}

}  // namespace sim::air
