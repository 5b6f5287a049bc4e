#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "hal/rtps/cursor.h"
#include "hal/rtps/entity_id.h"

namespace hal::rtps {

/// Kind of a submessage (OMG DDSI-RTPS 2.5, 9.4.5.1.1; 0x30 to 0x34: OMG DDS Security 1.1, 7.3.6).
/// There are others, of later versions (below 0x80) and of vendors; receivers skip them.
enum class SubmessageKind : std::uint8_t {
  kPad = 0x01,
  kAckNack = 0x06,
  kHeartbeat = 0x07,
  kGap = 0x08,
  kInfoTimestamp = 0x09,
  kInfoSource = 0x0c,
  kInfoReplyIp4 = 0x0d,
  kInfoDestination = 0x0e,
  kInfoReply = 0x0f,
  kNackFrag = 0x12,
  kHeartbeatFrag = 0x13,
  kData = 0x15,
  kDataFrag = 0x16,
  kSecureBody = 0x30,
  kSecurePrefix = 0x31,
  kSecurePostfix = 0x32,
  kSecureRtpsPrefix = 0x33,
  kSecureRtpsPostfix = 0x34,
};

/// "DATA", "HEARTBEAT", …; "vendor's" or "unknown" for others.
std::string_view name_of(SubmessageKind kind);

/// One submessage of a datagram, as Walk returns it.
struct Submessage {
  SubmessageKind kind = SubmessageKind::kPad;
  std::uint8_t flags = 0;
  std::size_t at = 0;  ///< Offset of its header within the datagram, octets.
  Octets body;         ///< The octets after the header of four octets.

  Endianness endianness() const { return has_flag(0) ? Endianness::kLittle : Endianness::kBig; }
  /// Flag X of the standard's tables: the bit with that number, 0 being E.
  bool has_flag(unsigned bit) const { return (flags >> bit & 1U) != 0; }
  /// Whether it goes from one endpoint to another, so that reader() and writer() are defined.
  bool has_endpoints() const;
  EntityId reader() const;  ///< kUnknownEntity: every matching reader; also if there is none.
  EntityId writer() const;
  /// Octets as transmitted, including the header.
  std::size_t size() const { return 4 + body.size(); }
};

}  // namespace hal::rtps
