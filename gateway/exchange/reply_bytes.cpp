#include "gateway/exchange/reply_bytes.h"

#include "exchangePubSubTypes.h"
#include "gateway/exchange/convert.h"
#include "gateway/exchange/wire_bytes.h"

namespace gateway::exchange {

std::vector<std::uint8_t> bytes_of(const hal::node::exchange::Reply& reply) {
  wire::Reply sample;
  to_wire(reply, {}, sample);
  return wire_bytes<wire::ReplyPubSubType>(sample);
}

hal::Result<hal::node::exchange::Reply> reply_of(std::span<const std::uint8_t> bytes) {
  wire::Reply sample;
  if (!read_wire_bytes<wire::ReplyPubSubType>(bytes, sample)) {
    return hal::fail(hal::Errc::kProtocol, "the bytes are of no reply");
  }
  return from_wire(sample);
}

}  // namespace gateway::exchange
