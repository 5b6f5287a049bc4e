#pragma once

#include <cstdint>

#include "hal/rtps/cursor.h"
#include "hal/rtps/fault.h"

namespace hal::rtps {

/// One parameter of a list: an id, and octets whose meaning the id determines.
struct Parameter {
  std::uint16_t id = 0;
  Octets value;
};

/// Ids that are evaluated (OMG DDSI-RTPS 2.5, tables 9.13 and 9.15).
namespace parameter {
inline constexpr std::uint16_t kPad = 0x0000;
inline constexpr std::uint16_t kSentinel = 0x0001;
inline constexpr std::uint16_t kTopicName = 0x0005;
inline constexpr std::uint16_t kTypeName = 0x0007;
inline constexpr std::uint16_t kReliability = 0x001a;
inline constexpr std::uint16_t kDurability = 0x001d;
inline constexpr std::uint16_t kDeadline = 0x0023;
inline constexpr std::uint16_t kPartition = 0x0029;
inline constexpr std::uint16_t kHistory = 0x0040;
inline constexpr std::uint16_t kParticipantGuid = 0x0050;
inline constexpr std::uint16_t kEndpointGuid = 0x005a;
inline constexpr std::uint16_t kKeyHash = 0x0070;
inline constexpr std::uint16_t kStatusInfo = 0x0071;
}  // namespace parameter

/// Iterates over a ParameterList (9.4.2.11): an id, a length and that number of octets, repeated
/// until the sentinel.
///
///   ParameterList list(cursor, endianness);
///   while (const Parameter* one = list.next()) …
///   if (!list.objection().empty()) …
class ParameterList {
 public:
  /// @param cursor  at the first parameter; after the sentinel once next() has returned null.
  ParameterList(Cursor& cursor, Endianness endianness) : cursor_(cursor), endianness_(endianness) {}

  /// Null at the sentinel, or where the list is malformed.
  const Parameter* next();
  Objection objection() const { return objection_; }
  Endianness endianness() const { return endianness_; }

 private:
  Cursor& cursor_;
  Endianness endianness_;
  Parameter current_;
  Objection objection_;
};

}  // namespace hal::rtps
