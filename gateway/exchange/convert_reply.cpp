#include <variant>

#include "gateway/exchange/convert.h"
#include "gateway/exchange/ranges.h"
#include "hal/types/overloaded.h"

namespace gateway::exchange {
namespace {

static_assert(static_cast<int>(hal::log::Level::kError) == static_cast<int>(wire::LEVEL_ERROR));

/// The optional parts of an action.
struct ActionParts {
  bool drive = false, outgoing = false, value = false;
};

/// Resizes the parts, reusing their memory; resets the other members to the values that they have
/// in actions that do not use them.
void clear(wire::Action& out, const ActionParts& parts) {
  out.drive().resize(parts.drive ? 1 : 0);
  out.outgoing().resize(parts.outgoing ? 1 : 0);
  out.timer(0);
  out.at(0);
  out.radio_on(true);
  out.text().clear();
  out.value().resize(parts.value ? 1 : 0);
  out.level(wire::LEVEL_INFO);
}

void to_wire(const hal::node::exchange::DriveBody& body, wire::Action& out) {
  clear(out, {.drive = true});
  out.kind(wire::DRIVE_BODY);
  wire::Drive& drive = out.drive()[0];
  drive.vx(body.twist.vx);
  drive.vy(body.twist.vy);
  drive.omega(body.twist.omega);
  drive.wheel_speeds().clear();
}

void to_wire(const hal::node::exchange::DriveWheels& each, wire::Action& out) {
  clear(out, {.drive = true});
  out.kind(wire::DRIVE_WHEELS);
  wire::Drive& drive = out.drive()[0];
  drive.vx(0);
  drive.vy(0);
  drive.omega(0);
  drive.wheel_speeds(each.speeds);
}

void to_wire(const hal::node::exchange::Send& message, wire::Action& out) {
  clear(out, {.outgoing = true});
  out.kind(wire::SEND);
  wire::Outgoing& outgoing = out.outgoing()[0];
  outgoing.message_id(message.id);
  outgoing.destination(message.destination.value);
  outgoing.topic(message.topic);
  outgoing.payload(message.payload);
  outgoing.priority(hal::to_number(message.priority));
}

void to_wire(const hal::node::exchange::Invalidate& routes, wire::Action& out) {
  clear(out, {.outgoing = true});
  out.kind(wire::INVALIDATE);
  wire::Outgoing& outgoing = out.outgoing()[0];
  outgoing.message_id(0);
  outgoing.destination(routes.destination.value);
  outgoing.topic(routes.topic);
  outgoing.payload().clear();
  outgoing.priority(0);
}

void to_wire(const hal::node::exchange::SetTimer& timer, wire::Action& out) {
  clear(out, {});
  out.kind(wire::TIMER_SET);
  out.timer(timer.timer);
  out.at(hal::to_ns(timer.at));
}

void to_wire(const hal::node::exchange::SetRadio& radio, wire::Action& out) {
  clear(out, {});
  out.kind(wire::RADIO);
  out.radio_on(radio.on);
}

void to_wire(const hal::node::exchange::SetState& state, wire::Action& out) {
  clear(out, {});
  out.kind(wire::STATE);
  out.text(state.name);
}

void to_wire(const hal::node::exchange::Log& line, wire::Action& out) {
  clear(out, {});
  out.kind(wire::LOG);
  out.text(line.text);
  out.level(static_cast<wire::LogLevel>(line.level));
}

void to_wire(const hal::node::exchange::ControllerFailed& error, wire::Action& out) {
  clear(out, {});
  out.kind(wire::ERROR);
  out.text(error.text);
}

void to_wire(const hal::node::exchange::Record& record, wire::Action& out) {
  clear(out, {.value = true});
  out.kind(wire::RECORD);
  out.text(record.name);
  out.value()[0] = record.value;
  out.at(hal::to_ns(record.at));
}

void to_wire(const hal::node::exchange::Action& action, wire::Action& out) {
  out.agent(action.agent.value);
  out.event(action.event);
  std::visit([&](const auto& what) { to_wire(what, out); }, action.what);
}

/// Whether the kind is known, and the action has exactly the parts that it needs.
bool is_complete(const wire::Action& action, Ranges& ranges) {
  const wire::ActionKind kind = action.kind();
  const bool has_drive = kind == wire::DRIVE_BODY || kind == wire::DRIVE_WHEELS;
  const bool has_outgoing = kind == wire::SEND || kind == wire::INVALIDATE;
  const bool has_value = kind == wire::RECORD;
  return ranges.is_known(kind, wire::RECORD, "action kind") &&
         ranges.exactly(action.drive().size(), has_drive ? 1 : 0, "velocities") &&
         ranges.exactly(action.outgoing().size(), has_outgoing ? 1 : 0, "messages") &&
         ranges.exactly(action.value().size(), has_value ? 1 : 0, "values");
}

hal::node::exchange::DriveBody drive_body_of(const wire::Drive& drive) {
  return {{drive.vx(), drive.vy(), drive.omega()}};
}

hal::node::exchange::Send send_of(const wire::Outgoing& outgoing) {
  return {outgoing.message_id(), hal::AgentId{outgoing.destination()}, outgoing.topic(),
          outgoing.payload(), hal::Priority{outgoing.priority()}};
}

hal::node::exchange::Action::What what_of(const wire::Action& action, Ranges& ranges) {
  const hal::Time at = hal::time_from_ns(action.at());
  const auto level = ranges.enumerator(action.level(), hal::log::Level::kError, "log level");
  if (!is_complete(action, ranges)) return {};
  switch (action.kind()) {
    case wire::DRIVE_BODY:
      return drive_body_of(action.drive()[0]);
    case wire::DRIVE_WHEELS:
      return hal::node::exchange::DriveWheels{action.drive()[0].wheel_speeds()};
    case wire::SEND:
      return send_of(action.outgoing()[0]);
    case wire::INVALIDATE:
      return hal::node::exchange::Invalidate{hal::AgentId{action.outgoing()[0].destination()},
                                             action.outgoing()[0].topic()};
    case wire::TIMER_SET:
      return hal::node::exchange::SetTimer{action.timer(), at};
    case wire::RADIO:
      return hal::node::exchange::SetRadio{action.radio_on()};
    case wire::STATE:
      return hal::node::exchange::SetState{action.text()};
    case wire::LOG:
      return hal::node::exchange::Log{level, action.text()};
    case wire::ERROR:
      return hal::node::exchange::ControllerFailed{action.text()};
    case wire::RECORD:
      return hal::node::exchange::Record{action.text(), action.value()[0], at};
  }
  return {};
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
  hal::node::exchange::Reply out;
  out.process = reply.process();
  out.run = reply.run();
  out.sequence = reply.sequence_number();
  out.actions.reserve(reply.actions().size());
  for (const wire::Action& action : reply.actions()) {
    Ranges ranges;
    out.actions.push_back({hal::AgentId{action.agent()}, action.event(), what_of(action, ranges)});
    if (auto good = ranges.check(); !good)
      return malformed("action", out.actions.size() - 1, action.agent(), good.error());
  }
  return out;
}

}  // namespace gateway::exchange
