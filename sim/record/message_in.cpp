#include "sim/record/message_in.h"

#include <variant>

#include "hal/routing/frame.h"
#include "hal/routing/one_hop.h"

namespace sim::record {

std::optional<MessageName> message_in(const radio::MacRequest& request, hal::AgentId source) {
  if (request.ethertype != radio::kEthertypeRouting || !request.payload) return std::nullopt;
  const auto one_hop = hal::routing::parse_one_hop(*request.payload, source, request.destination);
  if (one_hop) return MessageName{source, one_hop->id};
  const auto routed = hal::routing::parse_frame(*request.payload);
  const auto* packet = routed ? hal::routing::packet_in(*routed) : nullptr;
  const auto* data = packet ? std::get_if<hal::routing::Data>(packet) : nullptr;
  if (data == nullptr) return std::nullopt;
  return MessageName{data->header.source, data->id};
}

}  // namespace sim::record
