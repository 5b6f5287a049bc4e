#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "hal/rtps/cursor.h"
#include "hal/rtps/entity_id.h"

namespace hal::rtps {

/// The identity of a participant, writer or reader (OMG DDSI-RTPS 2.5, 9.3.1).
struct Guid {
  GuidPrefix prefix;
  EntityId entity;
  bool operator==(const Guid&) const = default;
  auto operator<=>(const Guid&) const = default;
};

/// HISTORY of a writer (OMG DDS 1.4, 2.2.3.18).
struct DiscoveredHistory {
  bool keeps_all = false;
  std::uint32_t depth = 0;  ///< Samples of each instance; without meaning if it keeps all.
};

/// The description of a writer or reader in SEDP (9.6.2.2). Views into the payload.
struct DiscoveredEndpoint {
  Guid guid;               ///< PID_ENDPOINT_GUID, or the key hash of a disposed endpoint.
  std::string_view topic;  ///< Empty: not given, e.g. for a disposed endpoint.
  std::string_view type;   ///< Likewise.
  /// 1 best effort, 2 reliable; 0: not given, the standard's default.
  std::uint32_t reliability = 0;
  std::uint32_t durability = 0;  ///< 0 volatile, 1 transient local, 2 transient, 3 persistent.
  /// Period within which a writer offers a new sample [ns]; nullopt: not given, or infinite.
  std::optional<std::int64_t> deadline{};
  /// HISTORY, which few implementations announce; nullopt: not given.
  std::optional<DiscoveredHistory> history{};
  Octets partitions;                         ///< The encoded sequence of strings; empty: not given.
  Endianness endianness = Endianness::kBig;  ///< Encoding of `partitions`.
};

/// Reads the payload of a DATA of a SEDP writer of publications or subscriptions, without
/// allocation.
/// @return nullopt: it names no endpoint, or is truncated.
std::optional<DiscoveredEndpoint> read_endpoint(Octets payload);

}  // namespace hal::rtps
