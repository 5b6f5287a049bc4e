#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace hal::rtps {

/// A reader or writer within its participant (OMG DDSI-RTPS 2.5, 9.3.1.2): three octets of key,
/// then one for its kind, read as one number, so that the SPDP writer is 0x000100c2.
struct EntityId {
  std::uint32_t value = 0;
  bool operator==(const EntityId&) const = default;
  auto operator<=>(const EntityId&) const = default;

  /// Whether it serves discovery, liveliness or security rather than a program's topic (9.3.1.3).
  constexpr bool is_builtin() const { return (value & 0xc0U) == 0xc0U; }
  constexpr bool is_writer() const { return kind() == 2 || kind() == 3; }
  constexpr bool is_reader() const { return kind() == 4 || kind() == 7; }

 private:
  constexpr std::uint32_t kind() const { return value & 0x3fU; }
};

inline constexpr EntityId kUnknownEntity{0};
inline constexpr EntityId kParticipantEntity{0x000001c1};
inline constexpr EntityId kSpdpWriter{0x000100c2};
inline constexpr EntityId kSpdpReader{0x000100c7};
inline constexpr EntityId kSedpTopicWriter{0x000002c2};
inline constexpr EntityId kSedpPublicationWriter{0x000003c2};
inline constexpr EntityId kSedpSubscriptionWriter{0x000004c2};
inline constexpr EntityId kParticipantMessageWriter{0x000200c2};

/// "SPDP writer" etc. for those with a name in the standard (table 9.3, and 7.4 of OMG DDS Security
/// 1.1), otherwise "user writer", "builtin reader" etc.
std::string_view name_of(EntityId entity);

/// The first 12 octets of the GUIDs of all entities in a participant (9.3.1.5).
struct GuidPrefix {
  std::array<std::byte, 12> octets{};
  bool operator==(const GuidPrefix&) const = default;
  auto operator<=>(const GuidPrefix&) const = default;
};

}  // namespace hal::rtps
