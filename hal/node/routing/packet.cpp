#include "hal/node/routing/packet.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "hal/node/routing/byte_order.h"
#include "hal/types/check.h"

namespace hal::node::routing {
namespace {

constexpr std::uint8_t kVersion = 1;
enum class Kind : std::uint8_t {
  kForwardAnt = 1,
  kBackwardAnt = 2,
  kData = 3,
  kControl = 10,
  kPriorityData = 14,
};

std::uint8_t first_octet(Kind kind) {
  return static_cast<std::uint8_t>(kVersion << 4 | static_cast<std::uint8_t>(kind));
}

void put(ByteWriter& out, const PathStatistics& way) {
  out.u16(way.hops);
  out.u64(static_cast<std::uint64_t>(way.delay.count()));
  out.u64(std::bit_cast<std::uint64_t>(way.min_snr_db));
  out.u64(std::bit_cast<std::uint64_t>(way.energy));
}

void put(ByteWriter& out, const std::vector<AgentId>& path) {
  BARAKA_CHECK(path.size() <= kMaxPath);
  out.u8(static_cast<std::uint8_t>(path.size()));
  for (const AgentId node : path) out.u16(node.value);
}

void put(ByteWriter& out, Kind kind, const Header& header) {
  BARAKA_CHECK(!header.topic.empty() && header.topic.size() <= kMaxTopic);
  out.u8(first_octet(kind));
  out.u8(static_cast<std::uint8_t>(header.topic.size()));
  for (const char c : header.topic) out.u8(static_cast<std::uint8_t>(c));
  out.u16(header.source.value);
  out.u16(header.destination.value);
  out.u32(header.sequence);
}

void put(ByteWriter& out, const ForwardAnt& ant) {
  put(out, Kind::kForwardAnt, ant.header);
  out.u64(static_cast<std::uint64_t>(to_ns(ant.started)));
  put(out, ant.way);
  put(out, ant.path);
}

void put(ByteWriter& out, const BackwardAnt& ant) {
  put(out, Kind::kBackwardAnt, ant.header);
  out.u8(ant.position);
  put(out, ant.way);
  put(out, ant.path);
}

void put(ByteWriter& out, const Data& data) {
  const bool has_priority = data.priority != Priority::kBestEffort;
  BARAKA_CHECK(to_number(data.priority) <= kHighestPriority);
  put(out, has_priority ? Kind::kPriorityData : Kind::kData, data.header);
  if (has_priority) out.u8(to_number(data.priority));
  out.u32(data.id);
  out.u8(data.transmissions);
  out.bytes(data.payload);
}

void put(ByteWriter& out, const Control& control) {
  BARAKA_CHECK(!control.body.empty() && control.body.size() <= kMaxControl);
  out.u8(first_octet(Kind::kControl));
  out.u8(static_cast<std::uint8_t>(control.protocol));
  out.bytes(control.body);
}

PathStatistics take_way(ByteReader& in) {
  PathStatistics way;
  way.hops = in.u16();
  way.delay = Duration{static_cast<std::int64_t>(in.u64())};
  way.min_snr_db = std::bit_cast<double>(in.u64());
  way.energy = std::bit_cast<double>(in.u64());
  return way;
}

std::vector<AgentId> take_path(ByteReader& in) {
  std::vector<AgentId> path(in.u8());
  for (AgentId& node : path) node.value = in.u16();
  return path;
}

Header take_header(ByteReader& in) {
  Header header;
  header.topic = in.text(in.u8());
  header.source.value = in.u16();
  header.destination.value = in.u16();
  header.sequence = in.u32();
  return header;
}

bool is_valid(const Header& header) {
  return !header.topic.empty() && header.topic.size() <= kMaxTopic &&
         !is_broadcast(header.source) && header.source != header.destination;
}

// Bounds that no real path reaches, so that sums over hops cannot overflow.
constexpr Duration kMaxDelay = std::chrono::hours{24};
constexpr double kMaxEnergy = 1e9;  // J

bool is_valid(const PathStatistics& way) {
  return way.delay >= Duration::zero() && way.delay <= kMaxDelay && std::isfinite(way.min_snr_db) &&
         way.energy >= 0 && way.energy <= kMaxEnergy;
}

/// Whether a path starts at `start`, visits no node twice, and does not contain `end`.
bool is_valid(const std::vector<AgentId>& path, AgentId start, AgentId end) {
  if (path.empty() || path.front() != start) return false;
  std::vector<AgentId> nodes = path;
  nodes.push_back(end);
  nodes.insert(nodes.end(), {kNeighbours, kEveryone});
  std::sort(nodes.begin(), nodes.end());
  return std::adjacent_find(nodes.begin(), nodes.end()) == nodes.end();
}

std::optional<Packet> parse_forward_ant(Header header, ByteReader& in) {
  ForwardAnt ant{.header = std::move(header), .started = {}, .path = {}, .way = {}};
  ant.started = time_from_ns(static_cast<std::int64_t>(in.u64()));
  ant.way = take_way(in);
  ant.path = take_path(in);
  if (!in.ended_well() || !is_valid(ant.way) || ant.started < Time{}) return std::nullopt;
  if (!is_valid(ant.path, ant.header.source, ant.header.destination)) return std::nullopt;
  if (ant.way.hops + 1u != ant.path.size()) return std::nullopt;
  return ant;
}

std::optional<Packet> parse_backward_ant(Header header, ByteReader& in) {
  BackwardAnt ant{.header = std::move(header), .path = {}, .position = 0, .way = {}};
  ant.position = in.u8();
  ant.way = take_way(in);
  ant.path = take_path(in);
  if (!in.ended_well() || !is_valid(ant.way)) return std::nullopt;
  if (!is_valid(ant.path, ant.header.destination, ant.header.source)) return std::nullopt;
  if (ant.position + std::size_t{ant.way.hops} + 1 != ant.path.size()) return std::nullopt;
  return ant;
}

std::optional<Packet> parse_data(Header header, Priority priority, ByteReader& in) {
  Data data{.header = std::move(header),
            .id = 0,
            .transmissions = 0,
            .payload = {},
            .priority = priority};
  data.id = in.u32();
  data.transmissions = in.u8();
  data.payload = in.rest();
  if (!in.ended_well() || data.payload.size() > kMaxPayload) return std::nullopt;
  if (data.id == 0 || data.transmissions == 0) return std::nullopt;
  if (data.header.destination == kNeighbours && data.transmissions > 1) return std::nullopt;
  return data;
}

/// Without a priority the bytes are those of plain data, so that a packet has one form only.
std::optional<Packet> parse_priority_data(Header header, ByteReader& in) {
  const std::uint8_t priority = in.u8();
  if (priority == 0 || priority > kHighestPriority) return std::nullopt;
  return parse_data(std::move(header), Priority{priority}, in);
}

std::optional<Packet> parse_control(ByteReader& in) {
  Control control{.protocol = static_cast<ControlOf>(in.u8()), .body = in.rest()};
  const bool is_known =
      control.protocol == ControlOf::kAodv || control.protocol == ControlOf::kAntHocNet;
  const bool has_length = !control.body.empty() && control.body.size() <= kMaxControl;
  if (!in.ended_well() || !is_known || !has_length) return std::nullopt;
  return control;
}

}  // namespace

Bytes encode(const Packet& packet) {
  ByteWriter out;
  std::visit([&out](const auto& kind) { put(out, kind); }, packet);
  return out.take();
}

std::optional<Packet> parse(std::span<const std::uint8_t> frame) {
  ByteReader in(frame);
  const std::uint8_t first = in.u8();
  if (first >> 4 != kVersion) return std::nullopt;
  if (first == first_octet(Kind::kControl)) return parse_control(in);
  Header header = take_header(in);
  if (!is_valid(header)) return std::nullopt;
  const bool is_flood = is_broadcast(header.destination);
  switch (static_cast<Kind>(first & 0x0f)) {
    case Kind::kForwardAnt:
      return is_flood ? std::nullopt : parse_forward_ant(std::move(header), in);
    case Kind::kBackwardAnt:
      return is_flood ? std::nullopt : parse_backward_ant(std::move(header), in);
    case Kind::kData:
      return parse_data(std::move(header), Priority::kBestEffort, in);
    case Kind::kPriorityData:
      return parse_priority_data(std::move(header), in);
    case Kind::kControl:
      break;  // has no header
  }
  return std::nullopt;
}

}  // namespace hal::node::routing
