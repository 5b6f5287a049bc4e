#include "hal/rtps/control.h"

#include <algorithm>
#include <limits>

#include "hal/rtps/number_set.h"

namespace hal::rtps {
namespace {

constexpr std::size_t kEndpoints = 8;     // octets: the ids of a reader and a writer
constexpr std::size_t kLocatorSize = 24;  // octets
constexpr unsigned kGroupFlag = 3;        // of a HEARTBEAT
constexpr unsigned kNoTimeFlag = 1;       // of an INFO_TS
constexpr unsigned kMulticastFlag = 1;    // of an INFO_REPLY

Objection end_of(const Cursor& cursor) {
  return cursor.is_short() ? "it is too short" : Objection{};
}

Objection judge_heartbeat(Cursor& cursor, bool has_group, const Limits& limits,
                          std::int64_t& first) {
  cursor.take(kEndpoints);
  first = cursor.sequence_number();
  const std::int64_t last = cursor.sequence_number();
  cursor.take(4 + (has_group ? 28 : 0));  // count; with a group, also its numbers and a digest
  if (cursor.is_short()) return "it is too short";
  if (first < 1) return "its first sequence number is below 1";
  if (first > limits.sequence_number) return "its first sequence number is far beyond the last one";
  if (last < first - 1) return "its last sequence number is before its first";
  // Receivers count on from this number.
  if (last == std::numeric_limits<std::int64_t>::max())
    return "its last sequence number is no number";
  return {};
}

Objection judge_acknack(Cursor& cursor) {
  cursor.take(kEndpoints);
  std::int64_t base = 0;
  // 0: the reader has just discovered the writer and asks for its samples (8.4.15.2,
  // "pre-emptive").
  const Objection objection = read_sequence_number_set(cursor, 0, base);
  if (!objection.empty()) return objection;
  cursor.take(4);  // count
  return end_of(cursor);
}

Objection judge_gap(Cursor& cursor, const Limits& limits) {
  cursor.take(kEndpoints);
  const std::int64_t start = cursor.sequence_number();
  if (start < 1) return "it starts below 1";
  std::int64_t base = 0;
  const Objection objection = read_sequence_number_set(cursor, 1, base);
  if (!objection.empty()) return objection;
  return base - start > limits.gap ? "it is too wide" : Objection{};
}

Objection judge_nack_frag(Cursor& cursor) {
  cursor.take(kEndpoints);
  if (cursor.sequence_number() < 1) return "its sequence number is below 1";
  const Objection objection = read_fragment_number_set(cursor);
  if (!objection.empty()) return objection;
  cursor.take(4);  // count
  return end_of(cursor);
}

Objection judge_heartbeat_frag(Cursor& cursor) {
  cursor.take(kEndpoints);
  if (cursor.sequence_number() < 1) return "its sequence number is below 1";
  if (cursor.u32() == 0) return "its last fragment has the number 0";
  cursor.take(4);  // count
  return end_of(cursor);
}

Objection judge_info_source(Cursor& cursor, GuidPrefix& source) {
  cursor.take(4);  // unused
  const std::uint8_t major = cursor.u8();
  cursor.take(3);  // minor version, vendor
  const Octets prefix = cursor.take(source.octets.size());
  if (cursor.is_short()) return "it is too short";
  if (major != 2) return "its major version is not 2";
  std::ranges::copy(prefix, source.octets.begin());
  return {};
}

Objection skip_locators(Cursor& cursor) {
  const std::uint32_t count = cursor.u32();
  if (count > cursor.left() / kLocatorSize) return "it is too short for its locators";
  cursor.take(count * kLocatorSize);
  return end_of(cursor);
}

Objection judge_info_reply(Cursor& cursor, bool has_multicast) {
  const Objection objection = skip_locators(cursor);
  return objection.empty() && has_multicast ? skip_locators(cursor) : objection;
}

Objection judge_size(Cursor& cursor, std::size_t size) {
  cursor.take(size);
  return end_of(cursor);
}

}  // namespace

Objection judge_control(const Submessage& submessage, const Limits& limits, GuidPrefix& source,
                        std::int64_t& sequence_number) {
  Cursor cursor(submessage.body, submessage.endianness());
  switch (submessage.kind) {
    case SubmessageKind::kHeartbeat:
      return judge_heartbeat(cursor, submessage.has_flag(kGroupFlag), limits, sequence_number);
    case SubmessageKind::kAckNack:
      return judge_acknack(cursor);
    case SubmessageKind::kGap:
      return judge_gap(cursor, limits);
    case SubmessageKind::kNackFrag:
      return judge_nack_frag(cursor);
    case SubmessageKind::kHeartbeatFrag:
      return judge_heartbeat_frag(cursor);
    case SubmessageKind::kInfoSource:
      return judge_info_source(cursor, source);
    case SubmessageKind::kInfoDestination:
      return judge_size(cursor, source.octets.size());
    case SubmessageKind::kInfoTimestamp:
      return submessage.has_flag(kNoTimeFlag) ? Objection{} : judge_size(cursor, 8);
    case SubmessageKind::kInfoReply:
      return judge_info_reply(cursor, submessage.has_flag(kMulticastFlag));
    case SubmessageKind::kInfoReplyIp4:
      return judge_size(cursor, submessage.has_flag(kMulticastFlag) ? 16 : 8);
    default:
      return {};
  }
}

}  // namespace hal::rtps
