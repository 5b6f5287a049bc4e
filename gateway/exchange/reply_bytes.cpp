#include "gateway/exchange/reply_bytes.h"

#include <algorithm>
#include <exception>

#include "exchangePubSubTypes.h"
#include "gateway/exchange/convert.h"
#include "gateway/guard/guarded_type.h"

namespace gateway::exchange {

std::vector<std::uint8_t> bytes_of(const hal::node::exchange::Reply& reply) {
  wire::Reply sample;
  to_wire(reply, {}, sample);
  guard::GuardedType<wire::ReplyPubSubType> type;
  guard::rtps::SerializedPayload_t payload(type.getSerializedSizeProvider(&sample)());
  // serialize() does not write the padding
  std::fill_n(payload.data, payload.max_size, guard::rtps::octet{});
  if (!type.serialize(&sample, &payload)) return {};
  return {payload.data, payload.data + payload.length};
}

hal::Result<hal::node::exchange::Reply> reply_of(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kEncapsulation = 4;
  if (bytes.size() < kEncapsulation)
    return hal::fail(hal::Errc::kProtocol, "too few bytes for a reply");
  guard::GuardedType<wire::ReplyPubSubType> type;
  guard::rtps::SerializedPayload_t payload(static_cast<std::uint32_t>(bytes.size()));
  std::ranges::copy(bytes, payload.data);
  payload.length = static_cast<std::uint32_t>(bytes.size());
  wire::Reply sample;
  if (!type.deserialize(&payload, &sample)) {
    return hal::fail(hal::Errc::kProtocol, "the bytes are of no reply");
  }
  return from_wire(sample);
}

}  // namespace gateway::exchange
