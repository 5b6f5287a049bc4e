#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "gateway/guard/guarded_type.h"

namespace gateway::exchange {

/// One for all samples: its constructor takes milliseconds, for it counts how large a sample may
/// be.
template <class PubSub>
guard::GuardedType<PubSub>& wire_type() {
  static guard::GuardedType<PubSub> type;
  return type;
}

/// A sample as DDS sends it, with its encapsulation. Empty: it cannot be encoded.
/// @tparam PubSub  generated for the type of the sample.
template <class PubSub>
std::vector<std::uint8_t> wire_bytes(typename PubSub::type& sample) {
  guard::GuardedType<PubSub>& type = wire_type<PubSub>();
  guard::rtps::SerializedPayload_t payload(type.getSerializedSizeProvider(&sample)());
  // serialize() does not write the padding
  std::fill_n(payload.data, payload.max_size, guard::rtps::octet{});
  if (!type.serialize(&sample, &payload)) return {};
  return {payload.data, payload.data + payload.length};
}

/// The reverse. @return false: the bytes are of no such sample, whose content is then unspecified.
template <class PubSub>
bool read_wire_bytes(std::span<const std::uint8_t> bytes, typename PubSub::type& sample) {
  constexpr std::size_t kEncapsulation = 4;
  if (bytes.size() < kEncapsulation) return false;
  guard::GuardedType<PubSub>& type = wire_type<PubSub>();
  guard::rtps::SerializedPayload_t payload(static_cast<std::uint32_t>(bytes.size()));
  std::ranges::copy(bytes, payload.data);
  payload.length = static_cast<std::uint32_t>(bytes.size());
  return type.deserialize(&payload, &sample);
}

}  // namespace gateway::exchange
