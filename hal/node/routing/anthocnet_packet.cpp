#include "hal/node/routing/anthocnet_packet.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "hal/node/routing/byte_order.h"
#include "hal/types/check.h"

namespace hal::node::routing::anthocnet {
namespace {

using std::chrono::milliseconds;

constexpr std::uint8_t kForwardAntOctet = 1;
constexpr std::uint8_t kBackwardAntOctet = 2;
constexpr std::uint8_t kHelloOctet = 3;
constexpr std::uint8_t kNoticeOctet = 4;
constexpr std::uint8_t kWarningOctet = 5;

constexpr Duration kLongestPeriod = std::chrono::hours{1};

// Bounds that no real path reaches, so that sums over hops cannot overflow.
constexpr Duration kLongestDelay = std::chrono::hours{24};
constexpr double kMostEnergy = 1e9;      // J
constexpr double kMostPheromone = 1e12;  // 1/s

void put_text(ByteWriter& out, const std::string& text) {
  BARAKA_CHECK(!text.empty() && text.size() <= kMaxTopic);
  out.u8(static_cast<std::uint8_t>(text.size()));
  for (const char c : text) out.u8(static_cast<std::uint8_t>(c));
}

void put_duration(ByteWriter& out, Duration value) {
  out.u64(static_cast<std::uint64_t>(value.count()));
}

void put_number(ByteWriter& out, double value) { out.u64(std::bit_cast<std::uint64_t>(value)); }

void put_count(ByteWriter& out, std::size_t count, std::size_t most) {
  BARAKA_CHECK(count <= most);
  out.u8(static_cast<std::uint8_t>(count));
}

void put_target(ByteWriter& out, const Target& target) {
  put_text(out, target.topic);
  out.u16(target.destination.value);
}

void put_ant_header(ByteWriter& out, const Header& header, AntKind kind) {
  put_text(out, header.topic);
  out.u16(header.source.value);
  out.u16(header.destination.value);
  out.u32(header.sequence);
  out.u8(static_cast<std::uint8_t>(kind));
}

void put_way(ByteWriter& out, const PathStatistics& way, const std::vector<AgentId>& path) {
  out.u16(way.hops);
  put_duration(out, way.delay);
  put_number(out, way.min_snr_db);
  put_number(out, way.energy);
  put_count(out, path.size(), kMaxPath);
  for (const AgentId node : path) out.u16(node.value);
}

void put_packet(ByteWriter& out, const ForwardAnt& ant) {
  out.u8(kForwardAntOctet);
  put_ant_header(out, ant.header, ant.kind);
  out.u8(ant.broadcasts);
  put_way(out, ant.way, ant.path);
}

void put_packet(ByteWriter& out, const BackwardAnt& ant) {
  out.u8(kBackwardAntOctet);
  put_ant_header(out, ant.header, ant.kind);
  out.u8(ant.position);
  put_way(out, ant.way, ant.path);
}

void put_packet(ByteWriter& out, const PheromoneHello& hello) {
  BARAKA_CHECK(hello.period >= milliseconds{1} && hello.period <= kLongestPeriod);
  out.u8(kHelloOctet);
  out.u32(static_cast<std::uint32_t>(std::chrono::ceil<milliseconds>(hello.period).count()));
  put_count(out, hello.scents.size(), kMostTargets);
  for (const Scent& scent : hello.scents) {
    put_target(out, scent.target);
    out.u16(scent.next_hop.value);
    out.u8(scent.is_virtual ? 1 : 0);
    out.u8(scent.hops);
    put_number(out, scent.pheromone);
  }
}

void put_packet(ByteWriter& out, const LossNotice& notice) {
  out.u8(kNoticeOctet);
  put_count(out, notice.lost.size(), kMostTargets);
  for (const LostPath& lost : notice.lost) {
    put_target(out, lost.target);
    out.u8(lost.hops);
    out.u16(lost.next_hop.value);
    put_duration(out, lost.delay);
  }
}

void put_packet(ByteWriter& out, const Warning& warning) {
  out.u8(kWarningOctet);
  put_target(out, warning.target);
}

std::string take_text(ByteReader& in) {
  const std::size_t size = in.u8();
  return in.text(size);
}

Duration take_duration(ByteReader& in) { return Duration{static_cast<std::int64_t>(in.u64())}; }

double take_number(ByteReader& in) { return std::bit_cast<double>(in.u64()); }

Target take_target(ByteReader& in) {
  Target target;
  target.topic = take_text(in);
  target.destination.value = in.u16();
  return target;
}

bool is_valid(Duration delay) { return delay >= Duration::zero() && delay <= kLongestDelay; }

bool is_valid(const Target& target) {
  return !target.topic.empty() && target.topic.size() <= kMaxTopic &&
         !is_broadcast(target.destination);
}

bool is_valid(const Header& header) {
  return is_valid(Target{header.topic, header.destination}) && !is_broadcast(header.source) &&
         header.source != header.destination;
}

bool is_valid(const PathStatistics& way) {
  return is_valid(way.delay) && std::isfinite(way.min_snr_db) && way.energy >= 0 &&
         way.energy <= kMostEnergy;
}

bool is_valid(const Scent& scent) {
  return is_valid(scent.target) && !is_broadcast(scent.next_hop) && scent.pheromone > 0 &&
         scent.pheromone <= kMostPheromone && (scent.is_virtual || scent.hops > 0);
}

bool is_valid(const LostPath& lost) {
  return is_valid(lost.target) && is_valid(lost.delay) &&
         (lost.hops == 0 || !is_broadcast(lost.next_hop));
}

/// Whether a path starts at `start`, visits no node twice, and does not contain `end`.
bool is_path(const std::vector<AgentId>& path, AgentId start, AgentId end) {
  if (path.empty() || path.front() != start) return false;
  std::vector<AgentId> nodes = path;
  nodes.insert(nodes.end(), {end, kNeighbours, kEveryone});
  std::sort(nodes.begin(), nodes.end());
  return std::adjacent_find(nodes.begin(), nodes.end()) == nodes.end();
}

/// Fields common to both kinds of ants.
struct AntBody {
  Header header;
  AntKind kind = AntKind::kReactive;
  std::uint8_t octet = 0;  ///< Broadcasts or position.
  PathStatistics way;
  std::vector<AgentId> path;
};

std::optional<AntBody> take_ant(ByteReader& in) {
  AntBody ant;
  ant.header.topic = take_text(in);
  ant.header.source.value = in.u16();
  ant.header.destination.value = in.u16();
  ant.header.sequence = in.u32();
  const std::uint8_t kind = in.u8();
  ant.octet = in.u8();
  ant.way.hops = in.u16();
  ant.way.delay = take_duration(in);
  ant.way.min_snr_db = take_number(in);
  ant.way.energy = take_number(in);
  ant.path.resize(in.u8());
  for (AgentId& node : ant.path) node.value = in.u16();
  if (!in.ended_well() || kind >= kAntKindCount) return std::nullopt;
  ant.kind = static_cast<AntKind>(kind);
  if (!is_valid(ant.header) || !is_valid(ant.way)) return std::nullopt;
  return ant;
}

std::optional<ControlPacket> take_forward_ant(ByteReader& in) {
  auto ant = take_ant(in);
  if (!ant || !is_path(ant->path, ant->header.source, ant->header.destination)) return {};
  if (ant->way.hops + 1u != ant->path.size()) return {};
  return ForwardAnt{std::move(ant->header), ant->kind, ant->octet, ant->way, std::move(ant->path)};
}

std::optional<ControlPacket> take_backward_ant(ByteReader& in) {
  auto ant = take_ant(in);
  if (!ant || !is_path(ant->path, ant->header.destination, ant->header.source)) return {};
  if (ant->octet + std::size_t{ant->way.hops} + 1 != ant->path.size()) return {};
  return BackwardAnt{std::move(ant->header), ant->kind, ant->octet, ant->way, std::move(ant->path)};
}

std::optional<ControlPacket> take_hello(ByteReader& in) {
  PheromoneHello hello;
  hello.period = milliseconds{in.u32()};
  const std::size_t count = in.u8();
  if (count > kMostTargets) return {};
  for (std::size_t i = 0; i < count; ++i) {
    Scent scent;
    scent.target = take_target(in);
    scent.next_hop.value = in.u16();
    const std::uint8_t is_virtual = in.u8();
    scent.is_virtual = is_virtual == 1;
    scent.hops = in.u8();
    scent.pheromone = take_number(in);
    if (is_virtual > 1 || !is_valid(scent)) return {};
    hello.scents.push_back(std::move(scent));
  }
  if (!in.ended_well() || hello.period <= Duration::zero() || hello.period > kLongestPeriod) {
    return {};
  }
  return hello;
}

std::optional<ControlPacket> take_notice(ByteReader& in) {
  LossNotice notice;
  const std::size_t count = in.u8();
  if (count > kMostTargets) return {};
  for (std::size_t i = 0; i < count; ++i) {
    LostPath lost;
    lost.target = take_target(in);
    lost.hops = in.u8();
    lost.next_hop.value = in.u16();
    lost.delay = take_duration(in);
    if (!is_valid(lost)) return {};
    notice.lost.push_back(std::move(lost));
  }
  if (!in.ended_well() || notice.lost.empty()) return {};
  return notice;
}

std::optional<ControlPacket> take_warning(ByteReader& in) {
  Warning warning{take_target(in)};
  if (!in.ended_well() || !is_valid(warning.target)) return {};
  return warning;
}

struct ControlName {
  std::string_view operator()(const ForwardAnt&) const { return "forward ant"; }
  std::string_view operator()(const BackwardAnt&) const { return "backward ant"; }
  std::string_view operator()(const PheromoneHello&) const { return "hello"; }
  std::string_view operator()(const LossNotice&) const { return "loss notice"; }
  std::string_view operator()(const Warning&) const { return "warning"; }
};

}  // namespace

std::string_view name_of(const ControlPacket& packet) { return std::visit(ControlName{}, packet); }

Bytes encode_control(const ControlPacket& packet) {
  ByteWriter out;
  std::visit([&out](const auto& kind) { put_packet(out, kind); }, packet);
  return out.take();
}

std::optional<ControlPacket> parse_control(std::span<const std::uint8_t> bytes) {
  ByteReader in(bytes);
  switch (in.u8()) {
    case kForwardAntOctet:
      return take_forward_ant(in);
    case kBackwardAntOctet:
      return take_backward_ant(in);
    case kHelloOctet:
      return take_hello(in);
    case kNoticeOctet:
      return take_notice(in);
    case kWarningOctet:
      return take_warning(in);
    default:
      return {};
  }
}

}  // namespace hal::node::routing::anthocnet
