#include "gateway/exchange/convert.h"
#include "gateway/exchange/convert_body.h"
#include "gateway/exchange/ranges.h"

namespace gateway::exchange {
namespace {

static_assert(static_cast<int>(hal::AgentKind::kRobot) == static_cast<int>(wire::ROBOT));

wire::AgentKind to_wire(hal::AgentKind kind) { return static_cast<wire::AgentKind>(kind); }

wire::ProcessIdentity to_wire(const process::ProcessIdentity& identity) {
  wire::ProcessIdentity out;
  out.host(identity.host);
  out.pid(identity.pid);
  out.start_time(identity.start_time);
  return out;
}

wire::Wants to_wire(const hal::Wants& wants) {
  wire::Wants out;
  out.channels(wants.channels);
  out.watched(wants.watched);
  out.neighbours(wants.neighbours);
  out.optional_channels(wants.optional);
  out.names(wants.names);
  return out;
}

hal::Wants from_wire(const wire::Wants& wants) {
  return {wants.channels(), wants.watched(), wants.neighbours(), wants.optional_channels(),
          wants.names()};
}

wire::Channel to_wire(const hal::Channel& channel) {
  wire::Channel out;
  out.id(channel.id);
  out.name(channel.name);
  out.kind(channel.kind);
  out.unit(channel.unit);
  out.length(channel.length);
  out.period(channel.period.count());
  out.frame(channel.frame);
  out.headings(channel.headings);
  out.low(channel.low);
  out.high(channel.high);
  out.position({channel.position.x, channel.position.y, channel.position.z});
  out.heading(channel.heading);
  return out;
}

hal::Channel from_wire(const wire::Channel& channel) {
  hal::Channel out;
  out.id = channel.id();
  out.name = channel.name();
  out.kind = channel.kind();
  out.unit = channel.unit();
  out.length = channel.length();
  out.period = hal::Duration{channel.period()};
  out.frame = channel.frame();
  out.headings = channel.headings();
  out.low = channel.low();
  out.high = channel.high();
  out.position = {channel.position()[0], channel.position()[1], channel.position()[2]};
  out.heading = channel.heading();
  return out;
}

wire::ParameterText to_wire(const hal::node::exchange::ParameterText& parameter) {
  wire::ParameterText out;
  out.name(parameter.name);
  out.value(parameter.value);
  out.place(parameter.place);
  out.is_list(parameter.is_list);
  out.items(parameter.items);
  return out;
}

wire::WheelRow to_wire(const std::array<double, 3>& row) {
  wire::WheelRow out;
  out.vx(row[0]);
  out.vy(row[1]);
  out.omega(row[2]);
  return out;
}

wire::AgentName to_wire(const hal::node::exchange::AgentName& agent) {
  wire::AgentName out;
  out.agent(agent.agent.value);
  out.name(agent.name);
  return out;
}

wire::AgentSession to_wire(const hal::node::exchange::AgentSession& session) {
  wire::AgentSession out;
  out.agent(session.agent.value);
  out.name(session.name);
  out.kind(to_wire(session.kind));
  out.seed(session.seed);
  out.control_period(session.control_period.count());
  for (const auto& parameter : session.parameters) out.parameters().push_back(to_wire(parameter));
  for (const hal::Channel& channel : session.channels) out.channels().push_back(to_wire(channel));
  for (const auto& row : session.limits.body_to_wheel) out.body_to_wheel().push_back(to_wire(row));
  for (const auto& row : session.limits.wheel_to_body) out.wheel_to_body().push_back(to_wire(row));
  out.wheel_speed(session.limits.wheel_speed);
  out.air_interface(session.air_interface);
  put_body(session.body, out);
  return out;
}

hal::node::exchange::AgentSession from_wire(const wire::AgentSession& session, Ranges& ranges) {
  hal::node::exchange::AgentSession out;
  out.agent = hal::AgentId{session.agent()};
  out.name = session.name();
  out.kind = ranges.enumerator(session.kind(), hal::AgentKind::kRobot, "agent kind");
  out.seed = session.seed();
  out.control_period = hal::Duration{session.control_period()};
  for (const wire::ParameterText& parameter : session.parameters()) {
    out.parameters.push_back({parameter.name(), parameter.value(), parameter.place(),
                              parameter.is_list(), parameter.items()});
  }
  for (const wire::Channel& channel : session.channels()) {
    out.channels.push_back(from_wire(channel));
  }
  for (const wire::WheelRow& row : session.body_to_wheel()) {
    out.limits.body_to_wheel.push_back({row.vx(), row.vy(), row.omega()});
  }
  for (const wire::WheelRow& row : session.wheel_to_body()) {
    out.limits.wheel_to_body.push_back({row.vx(), row.vy(), row.omega()});
  }
  out.limits.wheel_speed = session.wheel_speed();
  out.air_interface = session.air_interface();
  out.body = body_from_wire(session, ranges);
  return out;
}

}  // namespace

process::ProcessIdentity from_wire(const wire::ProcessIdentity& identity) {
  return {identity.host(), identity.pid(), identity.start_time()};
}

wire::Hello to_wire(const hal::node::exchange::Hello& hello) {
  wire::Hello out;
  out.version(hello.version);
  out.process(hello.process);
  out.instance(hello.instance);
  out.program(hello.program);
  out.identity(to_wire(process::ProcessIdentity{hello.host, hello.pid, hello.pid_start_time}));
  out.patterns(hello.patterns);
  out.kind(to_wire(hello.kind));
  out.both_kinds(hello.both_kinds);
  out.wants(to_wire(hello.wants));
  return out;
}

hal::Result<hal::node::exchange::Hello> from_wire(const wire::Hello& hello) {
  Ranges ranges;
  hal::node::exchange::Hello out;
  out.version = hello.version();
  out.process = hello.process();
  out.instance = hello.instance();
  out.program = hello.program();
  out.host = hello.identity().host();
  out.pid = hello.identity().pid();
  out.pid_start_time = hello.identity().start_time();
  out.patterns = hello.patterns();
  out.kind = ranges.enumerator(hello.kind(), hal::AgentKind::kRobot, "agent kind");
  out.both_kinds = hello.both_kinds();
  out.wants = from_wire(hello.wants());
  if (auto checked = ranges.check(); !checked) return tl::unexpected(checked.error());
  return out;
}

wire::Session to_wire(const hal::node::exchange::Session& session,
                      const process::ProcessIdentity& server) {
  wire::Session out;
  out.version(session.version);
  out.server(session.server);
  out.instance(session.instance);
  out.identity(to_wire(server));
  out.run(session.run);
  out.refusal(session.refusal);
  for (const hal::node::exchange::AgentSession& agent : session.agents)
    out.agents().push_back(to_wire(agent));
  for (const hal::node::exchange::AgentName& one : session.directory)
    out.directory().push_back(to_wire(one));
  return out;
}

hal::Result<hal::node::exchange::Session> from_wire(const wire::Session& session) {
  Ranges ranges;
  hal::node::exchange::Session out;
  out.version = session.version();
  out.server = session.server();
  out.instance = session.instance();
  out.run = session.run();
  out.refusal = session.refusal();
  for (const wire::AgentSession& agent : session.agents()) {
    out.agents.push_back(from_wire(agent, ranges));
  }
  for (const wire::AgentName& one : session.directory()) {
    out.directory.push_back({hal::AgentId{one.agent()}, one.name()});
  }
  if (auto checked = ranges.check(); !checked) return tl::unexpected(checked.error());
  return out;
}

}  // namespace gateway::exchange
