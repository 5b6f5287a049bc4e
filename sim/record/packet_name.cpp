#include "sim/record/packet_name.h"

#include <array>
#include <variant>

#include "hal/routing/anthocnet_packet.h"
#include "hal/routing/aodv_message.h"
#include "hal/routing/frame.h"
#include "hal/routing/one_hop.h"

namespace sim::record {
namespace {

namespace routing = hal::routing;

std::string_view name_of(const routing::Control& control) {
  if (control.protocol == routing::ControlOf::kAodv) {
    constexpr std::array<std::string_view, 3> kNames{"RREQ", "RREP", "RERR"};
    const auto packet = routing::parse_aodv(control.body);
    return packet ? kNames.at(packet->message.index()) : "control";
  }
  constexpr std::array<std::string_view, 5> kNames{"forward ant", "backward ant", "hello",
                                                   "loss notice", "warning"};
  const auto packet = routing::anthocnet::parse_control(control.body);
  return packet ? kNames.at(packet->index()) : "control";
}

PacketName name_of(const routing::Packet& packet) {
  if (const auto* data = std::get_if<routing::Data>(&packet)) {
    return {"data", MessageName{data->header.source, data->id}};
  }
  if (const auto* control = std::get_if<routing::Control>(&packet)) return {name_of(*control), {}};
  return {std::holds_alternative<routing::ForwardAnt>(packet) ? "forward ant" : "backward ant", {}};
}

}  // namespace

PacketName packet_name(const radio::Frame& frame) {
  const bool is_data = frame.type == radio::FrameType::kData;
  if (!is_data || frame.ethertype != radio::kEthertypeRouting || !frame.payload) return {};
  const auto one_hop = routing::parse_one_hop(*frame.payload, frame.source(), frame.destination());
  if (one_hop) return {"data", MessageName{frame.source(), one_hop->id}};
  const auto routed = routing::parse_frame(*frame.payload);
  if (!routed) return {};
  if (const routing::Packet* packet = routing::packet_in(*routed)) return name_of(*packet);
  return {std::holds_alternative<routing::Hello>(*routed) ? "hello" : "hop acknowledgement", {}};
}

}  // namespace sim::record
