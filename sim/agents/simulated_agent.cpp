#include "sim/agents/simulated_agent.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "hal/types/log.h"
#include "hal/types/random.h"
#include "sim/agents/agent_offer.h"

namespace sim::agents {

using hal::exchange::Action;
using hal::exchange::ActionKind;
using hal::exchange::Cause;
using hal::exchange::Event;

SimulatedAgent::SimulatedAgent(const AgentConfig& config, radio::MacSap& mac,
                               Surroundings surroundings, AgentListener& listener)
    : config_(config),
      surroundings_(surroundings),
      listener_(listener),
      mac_(mac),
      link_(mac, surroundings.config.link),
      timers_(surroundings.events, config.id),
      router_(config.id, surroundings.config.routing, {surroundings.config.seed, config.name},
              {.link = link_, .timers = timers_, .application = *this, .observer = *this}) {
  link_.attach(router_);
}

void SimulatedAgent::start() {
  EventQueue& events = surroundings_.events;
  hal::Time first{};
  if (surroundings_.config.control_phase == ControlPhase::kUniform) {
    hal::RandomStream random(surroundings_.config.seed, name() + "/control");
    const double period = hal::to_seconds(surroundings_.config.control_period);
    first += hal::from_seconds(random.uniform() * period);
  }
  events.schedule(first, Rank::kScenario, id(), [this] { start_controller(); });
  events.schedule(first, Rank::kControl, id(), [this] { on_control(); });
}

void SimulatedAgent::start_controller() {
  if (std::exchange(started_, true)) return;
  add(event(Cause::kStart));
  for (Event& early : std::exchange(early_, {})) {
    early.time = surroundings_.events.now();
    add(std::move(early));
  }
}

void SimulatedAgent::on_control() {
  const hal::Time now = surroundings_.events.now();
  surroundings_.observer.on_body(now, id(), surroundings_.scene.body(id()));
  observe(now);
  if (!silent_) {
    Event control = event(Cause::kControl);
    sample(control);
    add(std::move(control));
  }
  surroundings_.events.schedule(now + surroundings_.config.control_period, Rank::kControl, id(),
                                [this] { on_control(); });
}

void SimulatedAgent::sample(Event& event) {
  if (!wants_channel("localisation")) return;
  const BodyState self = surroundings_.scene.body(id());
  const double range = surroundings_.config.localisation.range.value;
  hal::exchange::Reading reading{.channel = kLocalisation, .values = {}};
  for (const auto& other :
       sensing::localise({self.x, self.y, self.theta}, id(),
                         surroundings_.scene.near({self.x, self.y}, range), range)) {
    reading.values.insert(reading.values.end(), {static_cast<double>(other.agent.value),
                                                 other.position.x, other.position.y});
  }
  event.readings.push_back(std::move(reading));
}

hal::Result<void> SimulatedAgent::drive(const Action&) {
  return hal::fail(hal::Errc::kInvalidArgument, "a mote has no wheels");
}

Event SimulatedAgent::event(Cause cause) const {
  Event event;
  event.agent = id();
  event.time = surroundings_.events.now();
  event.cause = cause;
  return event;
}

void SimulatedAgent::add(Event event) {
  if (silent_) return;
  if (!started_) {
    early_.push_back(std::move(event));
    return;
  }
  inbox_.add(std::move(event));
  listener_.on_inbox(id());
}

void SimulatedAgent::add_stop_event() {
  start_controller();
  add(event(Cause::kStop));
}

std::vector<Event> SimulatedAgent::take_events() {
  std::vector<Event> events = inbox_.take();
  for (const Event& e : events) surroundings_.observer.on_event(e);
  return events;
}

hal::Result<void> SimulatedAgent::apply(const Action& action) {
  surroundings_.observer.on_action(surroundings_.events.now(), action);
  switch (action.kind) {
    case ActionKind::kDriveBody:
    case ActionKind::kDriveWheels:
      return drive(action);
    case ActionKind::kSend:
      return send(action);
    case ActionKind::kInvalidate:
      router_.invalidate(action.topic, action.destination);
      break;
    case ActionKind::kTimer:
      set_timer(action);
      break;
    case ActionKind::kRadio:
      mac_.set_radio(action.radio_on);
      break;
    case ActionKind::kState:
      set_state(action.text);
      break;
    case ActionKind::kLog:
      hal::log::write(action.level, surroundings_.events.now(), name() + "/controller",
                      action.text);
      break;
    case ActionKind::kError:
      break;  // ends the run; the simulation has seen it
  }
  return {};
}

hal::Result<void> SimulatedAgent::send(const Action& action) {
  if (action.topic.empty() || action.topic.size() > hal::kMaxTopic) {
    return hal::fail(hal::Errc::kInvalidArgument,
                     fmt::format("send: topic of {} bytes; 1 to {} are allowed",
                                 action.topic.size(), hal::kMaxTopic));
  }
  if (action.payload.size() > hal::kMaxPayload) {
    return hal::fail(hal::Errc::kInvalidArgument,
                     fmt::format("send: payload of {} bytes; up to {} are allowed",
                                 action.payload.size(), hal::kMaxPayload));
  }
  if (action.destination == id() || action.message_id == 0) {
    return hal::fail(
        hal::Errc::kInvalidArgument,
        fmt::format("send: message {} to agent {}: not to oneself, and numbered from 1",
                    action.message_id, action.destination.value));
  }
  if (auto admitted = topics_.admit(action.topic); !admitted) return admitted;
  const hal::Message message{.source = id(),
                             .destination = action.destination,
                             .id = action.message_id,
                             .topic = action.topic,
                             .payload = action.payload};
  surroundings_.observer.on_message_sent(surroundings_.events.now(), message);
  router_.send(message);
  return {};
}

void SimulatedAgent::set_timer(const Action& action) {
  EventQueue& events = surroundings_.events;
  EventQueue::EventId& pending = controller_timers_[action.timer];
  events.cancel(pending);
  // With a controller latency the wish may arrive after its time: then it is due at once.
  pending = events.schedule(std::max(action.at, events.now()), Rank::kNodeTimer, id(),
                            [this, timer = action.timer] {
                              Event due = event(Cause::kTimer);
                              due.timer = timer;
                              add(std::move(due));
                            });
}

void SimulatedAgent::set_state(const std::string& state) {
  last_state_ = state;
  hal::log::debug(surroundings_.events.now(), name(), "state {}", state);
  surroundings_.observer.on_state(surroundings_.events.now(), id(), state);
  listener_.on_state(id(), state);
}

void SimulatedAgent::silence(hal::Time stop_at) {
  if (std::exchange(silent_, true)) return;
  inbox_ = {};
  surroundings_.events.schedule(stop_at, Rank::kAction, id(), [this] { halt(); });
}

void SimulatedAgent::on_message(hal::Message message) {
  surroundings_.observer.on_message_delivered(surroundings_.events.now(), id(), message);
  Event received = event(Cause::kMessage);
  received.message = std::move(message);
  add(std::move(received));
}

void SimulatedAgent::on_fate(hal::MessageId message, hal::Fate fate) {
  surroundings_.observer.on_fate(surroundings_.events.now(), id(), message, fate);
  Event notice = event(Cause::kNotice);
  notice.noticed = message;
  notice.fate = fate;
  add(std::move(notice));
}

void SimulatedAgent::on_route_change(const hal::RouteChange& change) {
  const hal::Time now = surroundings_.events.now();
  surroundings_.observer.on_route_change(now, id(), change);
  const auto& watched = wants_.watched;
  if (silent_ || std::find(watched.begin(), watched.end(), change.route.topic) == watched.end()) {
    return;
  }
  inbox_.add(now, change);
}

void SimulatedAgent::on_neighbour(const hal::Neighbour& neighbour) {
  if (silent_ || !wants_.neighbours) return;
  inbox_.add(surroundings_.events.now(), neighbour);
  if (heard_.insert(neighbour.id).second) add(event(Cause::kLink));
}

void SimulatedAgent::on_neighbour_lost(hal::AgentId neighbour) {
  if (silent_ || !wants_.neighbours || heard_.erase(neighbour) == 0) return;
  inbox_.add_lost(surroundings_.events.now(), neighbour);
  add(event(Cause::kLink));
}

void SimulatedAgent::on_discovery(std::string_view topic, hal::AgentId destination,
                                  hal::Duration took, bool found) {
  const hal::Time now = surroundings_.events.now();
  hal::log::debug(now, name(), "discovery of {} for '{}': {} after {:.9f} s", destination.value,
                  topic, found ? "found" : "given up", hal::to_seconds(took));
  surroundings_.observer.on_discovery(now, id(), {topic, destination, took, found});
}

void SimulatedAgent::on_message_end(hal::AgentId sent_by, hal::MessageId message, std::string_view,
                                    hal::Verdict verdict) {
  surroundings_.observer.on_message_end(surroundings_.events.now(), id(), sent_by, message,
                                        verdict);
}

}  // namespace sim::agents
