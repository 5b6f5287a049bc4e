#include "hal/dds/convert.h"
#include "hal/dds/ranges.h"

namespace hal::dds {
namespace {

static_assert(static_cast<int>(exchange::ActionKind::kError) == static_cast<int>(wire::ERROR));
static_assert(static_cast<int>(exchange::ActionKind::kRadio) == static_cast<int>(wire::RADIO));
static_assert(static_cast<int>(log::Level::kError) == static_cast<int>(wire::LEVEL_ERROR));

void to_wire(const exchange::Action& action, wire::Action& out) {
  out.agent(action.agent.value);
  out.event(action.event);
  out.kind(static_cast<wire::ActionKind>(action.kind));
  out.vx(action.twist.vx);
  out.vy(action.twist.vy);
  out.omega(action.twist.omega);
  out.wheel_speeds(action.wheel_speeds);
  out.message_id(action.message_id);
  out.destination(action.destination.value);
  out.topic(action.topic);
  out.payload(action.payload);
  out.timer(action.timer);
  out.at(to_ns(action.at));
  out.radio_on(action.radio_on);
  out.text(action.text);
  out.level(static_cast<wire::LogLevel>(action.level));
}

exchange::Action from_wire(const wire::Action& action, Ranges& ranges) {
  exchange::Action out;
  out.agent = AgentId{action.agent()};
  out.event = action.event();
  out.kind = ranges.enumerator(action.kind(), exchange::ActionKind::kError, "action kind");
  out.twist = {action.vx(), action.vy(), action.omega()};
  out.wheel_speeds = action.wheel_speeds();
  out.message_id = action.message_id();
  out.destination = AgentId{action.destination()};
  out.topic = action.topic();
  out.payload = action.payload();
  out.timer = action.timer();
  out.at = time_from_ns(action.at());
  out.radio_on = action.radio_on();
  out.text = action.text();
  out.level = ranges.enumerator(action.level(), log::Level::kError, "log level");
  return out;
}

}  // namespace

void to_wire(const exchange::Reply& reply, const std::string& server, wire::Reply& out) {
  out.server(server);
  out.process(reply.process);
  out.run(reply.run);
  out.sequence_number(reply.sequence);
  out.actions().resize(reply.actions.size());
  for (std::size_t i = 0; i < reply.actions.size(); ++i) {
    to_wire(reply.actions[i], out.actions()[i]);
  }
}

Result<exchange::Reply> from_wire(const wire::Reply& reply) {
  Ranges ranges;
  exchange::Reply out;
  out.process = reply.process();
  out.run = reply.run();
  out.sequence = reply.sequence_number();
  out.actions.reserve(reply.actions().size());
  for (const wire::Action& action : reply.actions()) {
    out.actions.push_back(from_wire(action, ranges));
  }
  if (auto checked = ranges.check(); !checked) return tl::unexpected(checked.error());
  return out;
}

}  // namespace hal::dds
