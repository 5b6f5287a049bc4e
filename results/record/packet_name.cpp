#include "results/record/packet_name.h"

namespace results::record {

using hal::node::routing::FrameName;

FrameName packet_name(const sim::radio::Frame& frame, const Protocols& protocols) {
  const bool is_data = frame.type == sim::radio::FrameType::kData;
  if (!is_data || frame.ethertype != sim::radio::kEthertypeRouting || !frame.payload) return {};
  const auto* const protocol = protocols.of(frame.source());
  if (protocol == nullptr) return {};
  return protocol->name_frame({frame.source(), frame.destination(), *frame.payload});
}

FrameName packet_name(const sim::radio::AmsduPart& msdu, const Protocols& protocols) {
  const auto* const protocol = protocols.of(msdu.source);
  if (protocol == nullptr || msdu.ethertype != sim::radio::kEthertypeRouting) return {};
  return protocol->name_frame({msdu.source, msdu.destination, *msdu.payload});
}

FrameName packet_name(const sim::radio::MacRequest& request, hal::AgentId source,
                      const Protocols& protocols) {
  const auto* const protocol = protocols.of(source);
  const bool is_routed = request.ethertype == sim::radio::kEthertypeRouting && request.payload;
  if (!is_routed || protocol == nullptr) return {};
  return protocol->name_frame({source, request.destination, *request.payload});
}

}  // namespace results::record
