#include "hal/dds/exchange/reply_bytes.h"

#include <algorithm>
#include <exception>

#include "exchangePubSubTypes.h"
#include "hal/dds/exchange/convert.h"
#include "hal/dds/guarded_type.h"

namespace hal::dds {

std::vector<std::uint8_t> bytes_of(const exchange::Reply& reply) {
  wire::Reply sample;
  to_wire(reply, {}, sample);
  GuardedType<wire::ReplyPubSubType> type;
  rtps::SerializedPayload_t payload(type.getSerializedSizeProvider(&sample)());
  std::fill_n(payload.data, payload.max_size, rtps::octet{});  // Padding is left as it was.
  if (!type.serialize(&sample, &payload)) return {};
  return {payload.data, payload.data + payload.length};
}

Result<exchange::Reply> reply_of(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kEncapsulation = 4;
  if (bytes.size() < kEncapsulation) return fail(Errc::kProtocol, "too few bytes for a reply");
  GuardedType<wire::ReplyPubSubType> type;
  rtps::SerializedPayload_t payload(static_cast<std::uint32_t>(bytes.size()));
  std::ranges::copy(bytes, payload.data);
  payload.length = static_cast<std::uint32_t>(bytes.size());
  wire::Reply sample;
  if (!type.deserialize(&payload, &sample)) {
    return fail(Errc::kProtocol, "the bytes are of no reply");
  }
  return from_wire(sample);
}

}  // namespace hal::dds
