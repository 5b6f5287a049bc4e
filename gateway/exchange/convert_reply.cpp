#include "gateway/exchange/convert.h"
#include "gateway/exchange/ranges.h"

namespace gateway::exchange {
namespace {

static_assert(static_cast<int>(hal::node::exchange::ActionKind::kError) ==
              static_cast<int>(wire::ERROR));
static_assert(static_cast<int>(hal::node::exchange::ActionKind::kRecord) ==
              static_cast<int>(wire::RECORD));
static_assert(static_cast<int>(hal::node::exchange::ActionKind::kRadio) ==
              static_cast<int>(wire::RADIO));
static_assert(static_cast<int>(hal::log::Level::kError) == static_cast<int>(wire::LEVEL_ERROR));

bool has_outgoing(const hal::node::exchange::Action& action) {
  return action.kind == hal::node::exchange::ActionKind::kSend ||
         action.kind == hal::node::exchange::ActionKind::kInvalidate;
}

bool has_value(const hal::node::exchange::Action& action) {
  return action.kind == hal::node::exchange::ActionKind::kRecord;
}

void to_wire(const hal::node::exchange::Action& action, wire::Drive& out) {
  out.vx(action.twist.vx);
  out.vy(action.twist.vy);
  out.omega(action.twist.omega);
  out.wheel_speeds(action.wheel_speeds);
}

void from_wire(const wire::Drive& drive, hal::node::exchange::Action& out) {
  out.twist = {drive.vx(), drive.vy(), drive.omega()};
  out.wheel_speeds = drive.wheel_speeds();
}

void to_wire(const hal::node::exchange::Action& action, wire::Outgoing& out) {
  out.message_id(action.message_id);
  out.destination(action.destination.value);
  out.topic(action.topic);
  out.payload(action.payload);
}

void from_wire(const wire::Outgoing& outgoing, hal::node::exchange::Action& out) {
  out.message_id = outgoing.message_id();
  out.destination = hal::AgentId{outgoing.destination()};
  out.topic = outgoing.topic();
  out.payload = outgoing.payload();
}

void to_wire(const hal::node::exchange::Action& action, wire::Action& out) {
  out.agent(action.agent.value);
  out.event(action.event);
  out.kind(static_cast<wire::ActionKind>(action.kind));
  out.drive().resize(hal::node::exchange::drives(action) ? 1 : 0);
  if (hal::node::exchange::drives(action)) to_wire(action, out.drive()[0]);
  out.outgoing().resize(has_outgoing(action) ? 1 : 0);
  if (has_outgoing(action)) to_wire(action, out.outgoing()[0]);
  out.timer(action.timer);
  out.at(hal::to_ns(action.at));
  out.radio_on(action.radio_on);
  out.text(action.text);
  out.value().assign(has_value(action) ? 1 : 0, action.value);
  out.level(static_cast<wire::LogLevel>(action.level));
}

void from_wire(const wire::Action& action, Ranges& ranges, hal::node::exchange::Action& out) {
  out.agent = hal::AgentId{action.agent()};
  out.event = action.event();
  out.kind =
      ranges.enumerator(action.kind(), hal::node::exchange::ActionKind::kRecord, "action kind");
  ranges.exactly(action.drive().size(), hal::node::exchange::drives(out) ? 1 : 0,
                 "velocities in an action");
  if (!action.drive().empty()) from_wire(action.drive()[0], out);
  ranges.exactly(action.outgoing().size(), has_outgoing(out) ? 1 : 0, "messages in an action");
  if (!action.outgoing().empty()) from_wire(action.outgoing()[0], out);
  out.timer = action.timer();
  out.at = hal::time_from_ns(action.at());
  out.radio_on = action.radio_on();
  out.text = action.text();
  ranges.exactly(action.value().size(), has_value(out) ? 1 : 0, "values in an action");
  if (!action.value().empty()) out.value = action.value()[0];
  out.level = ranges.enumerator(action.level(), hal::log::Level::kError, "log level");
}

}  // namespace

void to_wire(const hal::node::exchange::Reply& reply, const std::string& server, wire::Reply& out) {
  out.server(server);
  out.process(reply.process);
  out.run(reply.run);
  out.sequence_number(reply.sequence);
  out.actions().resize(reply.actions.size());
  for (std::size_t i = 0; i < reply.actions.size(); ++i) {
    to_wire(reply.actions[i], out.actions()[i]);
  }
}

hal::Result<hal::node::exchange::Reply> from_wire(const wire::Reply& reply) {
  Ranges ranges;
  hal::node::exchange::Reply out;
  out.process = reply.process();
  out.run = reply.run();
  out.sequence = reply.sequence_number();
  out.actions.resize(reply.actions().size());
  for (std::size_t i = 0; i < out.actions.size(); ++i) {
    from_wire(reply.actions()[i], ranges, out.actions[i]);
  }
  if (auto checked = ranges.check(); !checked) return tl::unexpected(checked.error());
  return out;
}

}  // namespace gateway::exchange
