#include "hal/node/routing/frame.h"

#include "hal/node/routing/byte_order.h"
#include "hal/types/check.h"

namespace hal::node::routing {
namespace {

using std::chrono::milliseconds;

constexpr std::uint8_t kNumbered = 0x14;
constexpr std::uint8_t kHopAck = 0x15;
constexpr std::uint8_t kHello = 0x16;
constexpr std::size_t kNumberedHeader = 5;  // octets before the packet

std::uint32_t to_ms(Duration period) {
  return static_cast<std::uint32_t>(std::chrono::ceil<milliseconds>(period).count());
}

/// Whether a packet goes to one neighbour. Acknowledgements of a broadcast would all be sent at the
/// same time.
bool is_unicast(const Packet& packet) {
  if (std::holds_alternative<ForwardAnt>(packet)) return false;
  const auto* data = std::get_if<Data>(&packet);
  return data == nullptr || !is_broadcast(data->header.destination);
}

std::optional<Frame> parse_numbered(std::span<const std::uint8_t> bytes) {
  ByteReader in(bytes);
  in.u8();
  const HopNumber number = in.u32();
  if (bytes.size() <= kNumberedHeader) return std::nullopt;
  auto packet = parse(bytes.subspan(kNumberedHeader));
  if (!packet || !is_unicast(*packet)) return std::nullopt;
  return Numbered{number, std::move(*packet)};
}

std::optional<Frame> parse_hop_ack(std::span<const std::uint8_t> bytes) {
  ByteReader in(bytes);
  in.u8();
  const HopAck ack{in.u32()};
  return in.ended_well() ? std::optional<Frame>{ack} : std::nullopt;
}

std::optional<Frame> parse_hello(std::span<const std::uint8_t> bytes) {
  ByteReader in(bytes);
  in.u8();
  const Hello hello{milliseconds{in.u32()}};
  const bool is_valid = hello.period > Duration::zero() && hello.period <= kMaxHelloPeriod;
  return in.ended_well() && is_valid ? std::optional<Frame>{hello} : std::nullopt;
}

}  // namespace

Bytes encode_numbered(HopNumber number, const Bytes& packet) {
  ByteWriter out;
  out.u8(kNumbered);
  out.u32(number);
  out.bytes(packet);
  return out.take();
}

Bytes encode(const HopAck& ack) {
  ByteWriter out;
  out.u8(kHopAck);
  out.u32(ack.number);
  return out.take();
}

Bytes encode(const Hello& hello) {
  BARAKA_CHECK(hello.period >= milliseconds{1} && hello.period <= kMaxHelloPeriod);
  ByteWriter out;
  out.u8(kHello);
  out.u32(to_ms(hello.period));
  return out.take();
}

std::optional<Frame> parse_frame(std::span<const std::uint8_t> bytes) {
  if (bytes.empty()) return std::nullopt;
  if (bytes.front() == kNumbered) return parse_numbered(bytes);
  if (bytes.front() == kHopAck) return parse_hop_ack(bytes);
  if (bytes.front() == kHello) return parse_hello(bytes);
  auto packet = parse(bytes);
  return packet ? std::optional<Frame>{std::move(*packet)} : std::nullopt;
}

const Packet* packet_in(const Frame& frame) {
  if (const auto* numbered = std::get_if<Numbered>(&frame)) return &numbered->packet;
  return std::get_if<Packet>(&frame);
}

}  // namespace hal::node::routing
