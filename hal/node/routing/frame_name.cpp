#include "hal/node/routing/frame_name.h"

#include <variant>

#include "hal/node/routing/frame.h"

namespace hal::node::routing {
namespace {

/// Visitor that names one kind of packet or frame each.
struct NameOf {
  NameControl name_control;

  FrameName operator()(const ForwardAnt&) const { return {"forward ant"}; }
  FrameName operator()(const BackwardAnt&) const { return {"backward ant"}; }
  FrameName operator()(const Data& data) const {
    return {"data", FrameName::MessageName{data.header.source, data.id}};
  }
  FrameName operator()(const Control& control) const {
    const std::string_view name = name_control(control);
    return {name.empty() ? "control" : name};
  }
  FrameName operator()(const Packet& packet) const { return std::visit(*this, packet); }
  FrameName operator()(const Numbered& numbered) const { return (*this)(numbered.packet); }
  FrameName operator()(const HopAck&) const { return {"hop acknowledgement"}; }
  FrameName operator()(const Hello&) const { return {"hello"}; }
};

}  // namespace

FrameName frame_name(std::span<const std::uint8_t> bytes, NameControl name_control) {
  const auto frame = parse_frame(bytes);
  return frame ? std::visit(NameOf{name_control}, *frame) : FrameName{};
}

}  // namespace hal::node::routing
