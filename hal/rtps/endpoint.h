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

/// The description of a writer or reader in SEDP (9.6.2.2). Views into the payload.
struct DiscoveredEndpoint {
  Guid guid;               ///< PID_ENDPOINT_GUID, or the key hash of a disposed endpoint.
  std::string_view topic;  ///< Empty: not given, e.g. for a disposed endpoint.
  std::string_view type;   ///< Likewise.
  /// 1 best effort, 2 reliable; 0: not given, the standard's default.
  std::uint32_t reliability = 0;
  std::uint32_t durability = 0;  ///< 0 volatile, 1 transient local, 2 transient, 3 persistent.
  Octets partitions;             ///< The encoded sequence of strings; empty: not given.
  Endianness endianness = Endianness::kBig;  ///< Encoding of `partitions`.
};

/// Reads the payload of a DATA of a SEDP writer of publications or subscriptions, without
/// allocation.
/// @return nullopt: it names no endpoint, or is truncated.
std::optional<DiscoveredEndpoint> read_endpoint(Octets payload);

}  // namespace hal::rtps
