#include "hal/node/routing/aodv_message.h"

#include <algorithm>

#include "hal/node/routing/byte_order.h"
#include "hal/types/check.h"

namespace hal::node::routing {
namespace {

enum AodvType : std::uint8_t { kRreq = 1, kRrep = 2, kRerr = 3 };
// Flags of RREQ and RERR.
constexpr std::uint8_t kGratuitous = 0x20;
constexpr std::uint8_t kDestinationOnly = 0x10;
constexpr std::uint8_t kUnknownSequence = 0x08;
constexpr std::uint8_t kNoDelete = 0x80;

constexpr std::size_t kMostUnreachable = 255;

void put_address(ByteWriter& out, AgentId agent) { out.u32(agent.value); }

void put(ByteWriter& out, const Rreq& rreq) {
  std::uint8_t flags = 0;
  if (rreq.gratuitous) flags |= kGratuitous;
  if (rreq.destination_only) flags |= kDestinationOnly;
  if (!rreq.destination_sequence) flags |= kUnknownSequence;
  out.u8(kRreq);
  out.u8(flags);
  out.u8(0);
  out.u8(rreq.hops);
  out.u32(rreq.id);
  put_address(out, rreq.destination);
  out.u32(rreq.destination_sequence.value_or(0));
  put_address(out, rreq.originator);
  out.u32(rreq.originator_sequence);
}

void put(ByteWriter& out, const Rrep& rrep) {
  using std::chrono::milliseconds;
  out.u8(kRrep);
  out.u8(0);
  out.u8(0);
  out.u8(rrep.hops);
  put_address(out, rrep.destination);
  out.u32(rrep.destination_sequence);
  put_address(out, rrep.originator);
  out.u32(static_cast<std::uint32_t>(std::chrono::floor<milliseconds>(rrep.lifetime).count()));
}

void put(ByteWriter& out, const Rerr& rerr) {
  BARAKA_CHECK(!rerr.unreachable.empty() && rerr.unreachable.size() <= kMostUnreachable);
  out.u8(kRerr);
  out.u8(rerr.no_delete ? kNoDelete : 0);
  out.u8(0);
  out.u8(static_cast<std::uint8_t>(rerr.unreachable.size()));
  for (const auto& [destination, sequence] : rerr.unreachable) {
    put_address(out, destination);
    out.u32(sequence);
  }
}

/// Returns kEveryone, which parsing rejects, for a value that is not a node's address.
AgentId take_address(ByteReader& in) {
  const std::uint32_t address = in.u32();
  return address < kNeighbours.value ? AgentId{static_cast<std::uint16_t>(address)} : kEveryone;
}

std::optional<AodvMessage> take_rreq(ByteReader& in) {
  constexpr std::uint8_t kFlags = kGratuitous | kDestinationOnly | kUnknownSequence;
  const std::uint8_t flags = in.u8();
  if ((flags & ~kFlags) != 0 || in.u8() != 0) return std::nullopt;
  Rreq rreq{.gratuitous = (flags & kGratuitous) != 0,
            .destination_only = (flags & kDestinationOnly) != 0,
            .hops = in.u8(),
            .id = in.u32(),
            .destination = take_address(in)};
  const AodvSequence sequence = in.u32();
  if ((flags & kUnknownSequence) == 0) rreq.destination_sequence = sequence;
  rreq.originator = take_address(in);
  rreq.originator_sequence = in.u32();
  const bool has_ends = !is_broadcast(rreq.destination) && !is_broadcast(rreq.originator);
  if (!has_ends || rreq.destination == rreq.originator) return std::nullopt;
  return rreq;
}

std::optional<AodvMessage> take_rrep(ByteReader& in) {
  if (in.u8() != 0 || in.u8() != 0) return std::nullopt;
  Rrep rrep{.hops = in.u8(), .destination = take_address(in)};
  rrep.destination_sequence = in.u32();
  rrep.originator = take_address(in);
  rrep.lifetime = std::chrono::milliseconds{in.u32()};
  if (is_broadcast(rrep.destination) || is_broadcast(rrep.originator)) return std::nullopt;
  return rrep;
}

std::optional<AodvMessage> take_rerr(ByteReader& in) {
  const std::uint8_t flags = in.u8();
  if ((flags & ~kNoDelete) != 0 || in.u8() != 0) return std::nullopt;
  Rerr rerr{.no_delete = flags != 0, .unreachable = {}};
  const std::size_t count = in.u8();
  for (std::size_t i = 0; i < count; ++i) {
    const AgentId destination = take_address(in);
    rerr.unreachable.emplace_back(destination, in.u32());
    if (is_broadcast(destination)) return std::nullopt;
  }
  return count == 0 ? std::nullopt : std::optional<AodvMessage>{std::move(rerr)};
}

std::optional<AodvMessage> take_message(ByteReader& in) {
  switch (in.u8()) {
    case kRreq:
      return take_rreq(in);
    case kRrep:
      return take_rrep(in);
    case kRerr:
      return take_rerr(in);
    default:
      return std::nullopt;
  }
}

struct AodvName {
  std::string_view operator()(const Rreq&) const { return "RREQ"; }
  std::string_view operator()(const Rrep&) const { return "RREP"; }
  std::string_view operator()(const Rerr&) const { return "RERR"; }
};

}  // namespace

std::string_view name_of(const AodvMessage& message) { return std::visit(AodvName{}, message); }

Bytes encode(const AodvPacket& packet) {
  ByteWriter out;
  out.u8(packet.ttl);
  std::visit([&out](const auto& message) { put(out, message); }, packet.message);
  return out.take();
}

std::optional<AodvPacket> parse_aodv(const Bytes& body) {
  ByteReader in(body);
  const std::uint8_t ttl = in.u8();
  auto message = take_message(in);
  if (ttl == 0 || !message || !in.ended_well()) return std::nullopt;
  return AodvPacket{.ttl = ttl, .message = std::move(*message)};
}

}  // namespace hal::node::routing
