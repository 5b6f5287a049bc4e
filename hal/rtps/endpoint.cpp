#include "hal/rtps/endpoint.h"

#include <algorithm>

#include "hal/rtps/parameter_list.h"

namespace hal::rtps {
namespace {

constexpr std::uint16_t kLittleEndianList = 0x0003;  // PL_CDR_LE (10.2)

Guid to_guid(Octets value) {
  Guid guid;
  if (value.size() != 16) return guid;
  std::ranges::copy(value.first(guid.prefix.octets.size()), guid.prefix.octets.begin());
  guid.entity = Cursor(value.subspan(guid.prefix.octets.size()), Endianness::kBig).entity();
  return guid;
}

/// A length and that number of octets, of which the last is 0.
std::string_view to_text(Octets value, Endianness endianness) {
  Cursor cursor(value, endianness);
  const Octets text = cursor.take(cursor.u32());
  if (text.empty() || text.back() != std::byte{0}) return {};
  return {reinterpret_cast<const char*>(text.data()), text.size() - 1};
}

/// Duration_t (9.3.2): seconds and a fraction of 2^-32 s; infinite from 0x7fffffff s on.
std::optional<std::int64_t> to_period(Octets value, Endianness endianness) {
  Cursor cursor(value, endianness);
  const std::uint32_t seconds = cursor.u32(), fraction = cursor.u32();
  constexpr std::uint32_t kInfinite = 0x7fffffff;
  if (cursor.is_short() || seconds >= kInfinite) return std::nullopt;
  constexpr std::uint64_t kSecond = 1'000'000'000;
  return static_cast<std::int64_t>(seconds * kSecond + (fraction * kSecond >> 32U));
}

std::optional<DiscoveredHistory> to_history(Octets value, Endianness endianness) {
  Cursor cursor(value, endianness);
  const std::uint32_t kind = cursor.u32(), depth = cursor.u32();
  if (cursor.is_short()) return std::nullopt;
  return DiscoveredHistory{kind == 1, depth};
}

void read_parameter(const Parameter& one, Endianness endianness, DiscoveredEndpoint& endpoint) {
  switch (one.id) {
    case parameter::kEndpointGuid:
    case parameter::kKeyHash:
      endpoint.guid = to_guid(one.value);
      break;
    case parameter::kTopicName:
      endpoint.topic = to_text(one.value, endianness);
      break;
    case parameter::kTypeName:
      endpoint.type = to_text(one.value, endianness);
      break;
    case parameter::kReliability:
      endpoint.reliability = Cursor(one.value, endianness).u32();
      break;
    case parameter::kDurability:
      endpoint.durability = Cursor(one.value, endianness).u32();
      break;
    case parameter::kDeadline:
      endpoint.deadline = to_period(one.value, endianness);
      break;
    case parameter::kHistory:
      endpoint.history = to_history(one.value, endianness);
      break;
    case parameter::kPartition:
      endpoint.partitions = one.value;
      break;
    default:
      break;
  }
}

}  // namespace

std::optional<DiscoveredEndpoint> read_endpoint(Octets payload) {
  Cursor encapsulation(payload, Endianness::kBig);
  DiscoveredEndpoint endpoint;
  endpoint.endianness =
      encapsulation.u16() == kLittleEndianList ? Endianness::kLittle : Endianness::kBig;
  if (payload.size() < 4) return std::nullopt;
  Cursor content(payload.subspan(4), endpoint.endianness);
  ParameterList list(content, endpoint.endianness);
  while (const Parameter* one = list.next()) read_parameter(*one, endpoint.endianness, endpoint);
  if (endpoint.guid.entity == kUnknownEntity || !list.objection().empty()) return std::nullopt;
  return endpoint;
}

}  // namespace hal::rtps
