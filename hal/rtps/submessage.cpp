#include "hal/rtps/submessage.h"

namespace hal::rtps {
namespace {

/// Offset of the reader's id in the body; the writer's follows. 4 in DATA and DATA_FRAG, which
/// begin with extra flags and the distance to the inline QoS (9.4.5.3, 9.4.5.4).
std::size_t offset_of_reader(SubmessageKind kind) {
  return kind == SubmessageKind::kData || kind == SubmessageKind::kDataFrag ? 4 : 0;
}

EntityId entity_at(const Submessage& submessage, std::size_t offset) {
  if (!submessage.has_endpoints()) return kUnknownEntity;
  Cursor cursor(submessage.body, submessage.endianness());
  cursor.take(offset);
  return cursor.entity();
}

}  // namespace

std::string_view name_of(SubmessageKind kind) {
  switch (kind) {
    case SubmessageKind::kPad:
      return "PAD";
    case SubmessageKind::kAckNack:
      return "ACKNACK";
    case SubmessageKind::kHeartbeat:
      return "HEARTBEAT";
    case SubmessageKind::kGap:
      return "GAP";
    case SubmessageKind::kInfoTimestamp:
      return "INFO_TS";
    case SubmessageKind::kInfoSource:
      return "INFO_SRC";
    case SubmessageKind::kInfoReplyIp4:
      return "INFO_REPLY_IP4";
    case SubmessageKind::kInfoDestination:
      return "INFO_DST";
    case SubmessageKind::kInfoReply:
      return "INFO_REPLY";
    case SubmessageKind::kNackFrag:
      return "NACK_FRAG";
    case SubmessageKind::kHeartbeatFrag:
      return "HEARTBEAT_FRAG";
    case SubmessageKind::kData:
      return "DATA";
    case SubmessageKind::kDataFrag:
      return "DATA_FRAG";
    case SubmessageKind::kSecureBody:
      return "SEC_BODY";
    case SubmessageKind::kSecurePrefix:
      return "SEC_PREFIX";
    case SubmessageKind::kSecurePostfix:
      return "SEC_POSTFIX";
    case SubmessageKind::kSecureRtpsPrefix:
      return "SRTPS_PREFIX";
    case SubmessageKind::kSecureRtpsPostfix:
      return "SRTPS_POSTFIX";
  }
  return static_cast<std::uint8_t>(kind) >= 0x80 ? "vendor's" : "unknown";
}

bool Submessage::has_endpoints() const {
  switch (kind) {
    case SubmessageKind::kAckNack:
    case SubmessageKind::kHeartbeat:
    case SubmessageKind::kGap:
    case SubmessageKind::kNackFrag:
    case SubmessageKind::kHeartbeatFrag:
    case SubmessageKind::kData:
    case SubmessageKind::kDataFrag:
      return true;
    default:
      return false;
  }
}

EntityId Submessage::reader() const { return entity_at(*this, offset_of_reader(kind)); }
EntityId Submessage::writer() const { return entity_at(*this, offset_of_reader(kind) + 4); }

}  // namespace hal::rtps
