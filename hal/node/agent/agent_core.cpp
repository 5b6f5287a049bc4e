#include "hal/node/agent/agent_core.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "hal/node/exchange/validate.h"
#include "hal/types/check.h"
#include "hal/types/log.h"
#include "hal/types/overloaded.h"

namespace hal::node::agent {

using exchange::Action;
using exchange::Event;

AgentCore::AgentCore(exchange::AgentSession session, const routing::RoutingConfig& routing,
                     const Ports& ports)
    : ports_(ports),
      id_(session.agent),
      session_(std::move(session)),
      priorities_(routing.priorities),
      router_(
          session_.agent, routing, {session_.seed, session_.name},
          {.link = ports.link, .timers = ports.timers, .application = *this, .observer = *this}) {}

bool AgentCore::is_watched(const std::string& topic) const {
  return std::ranges::find(wants_.watched, topic) != wants_.watched.end();
}

void AgentCore::begin_anew(const Wants& wants) {
  for (const auto& [id, timer] : timers_) ports_.timers.cancel(timer);
  timers_.clear();
  topics_ = {};
  recorded_ = {};
  sent_.clear();
  told_.clear();
  inbox_ = {};
  early_.clear();
  wants_ = wants;
  asked_.clear();
  for (const Channel& channel : session_.channels) asked_.push_back(wants.asks_for(channel.name));
  asks_ = std::ranges::find(asked_, true) != asked_.end();
}

void AgentCore::connect(const Wants& wants) {
  begin_anew(wants);
  phase_ = Phase::kWaiting;
  for (Route& route : router_.routes()) {
    if (is_watched(route.topic)) inbox_.add(now(), {.route = std::move(route), .removed = false});
  }
  if (!wants_.neighbours) return;
  for (const Neighbour& neighbour : router_.neighbours()) {
    inbox_.add(now(), neighbour);
    told_.insert(neighbour.id);
  }
}

void AgentCore::disconnect() {
  begin_anew({});
  phase_ = Phase::kNoController;
}

void AgentCore::start() {
  if (phase_ != Phase::kWaiting) return;
  phase_ = Phase::kDriven;
  add(event(exchange::Start{}));
  for (Event& early : std::exchange(early_, {})) {
    early.time = now();
    add(std::move(early));
  }
}

void AgentCore::stop() {
  start();
  if (phase_ != Phase::kDriven) return;
  add(event(exchange::Stop{}));
  phase_ = Phase::kOver;
}

Event AgentCore::event(Event::What&& what) const {
  Event event;
  event.agent = id();
  event.time = now();
  event.what = std::move(what);
  return event;
}

void AgentCore::add(Event&& event) {
  if (phase_ == Phase::kWaiting) return early_.push_back(std::move(event));
  if (phase_ != Phase::kDriven) return;
  inbox_.add(std::move(event));
  ports_.listener.on_inbox(id());
}

std::vector<Event> AgentCore::take_events() {
  std::vector<Event> events;
  take_events(events);
  return events;
}

void AgentCore::take_events(std::vector<Event>& to) {
  const std::size_t first = to.size();
  inbox_.take(to);
  for (std::size_t i = first; i < to.size(); ++i) ports_.observer.on_event(to[i]);
}

void AgentCore::control() {
  ports_.observer.on_cycle(now(), id());
  ports_.sensors.advance(now());
  Event control = event(exchange::ControlDue{});
  if ((asks_ && is_connected()) || ports_.observer.observes_readings()) sample(control);
  add(std::move(control));
}

/// Samples each channel that the controller or an observer wants, once for both.
void AgentCore::sample(Event& control) {
  for (std::size_t i = 0; i < session_.channels.size(); ++i) {
    const Channel& channel = session_.channels[i];
    const bool is_observed = ports_.observer.observes(id(), channel);
    if (!is_asked_for(i) && !is_observed) continue;
    exchange::Reading reading{.channel = channel.id, .values = {}};
    reading.lost = !ports_.sensors.sample(i, control.time, reading.values);
    if (is_observed && !reading.lost) {
      ports_.observer.on_reading(control.time, id(), channel, reading.values);
    }
    if (is_asked_for(i)) control.readings.push_back(std::move(reading));
  }
}

Result<void> AgentCore::apply(const Action& action, Time as_of) {
  if (phase_ == Phase::kOver && !is_word(action)) return {};
  ports_.observer.on_action(now(), action);
  auto done = exchange::validate(action, session_);
  if (done) done = take_effect(action, as_of);
  if (!done) refuse(fmt::format("{}: {}", exchange::name(action), done.error().message));
  return done;
}

void AgentCore::refuse(const std::string& why) {
  ++refused_;
  if (const auto line = refusals_.take(now(), why)) {
    log::warning(now(), name(), "action refused: {}", *line);
  }
}

Result<void> AgentCore::take_effect(const Action& action, Time as_of) {
  using Done = Result<void>;
  return std::visit(
      Overloaded{
          [&](const exchange::DriveBody& body) { return wheels().drive(body.twist, as_of); },
          [&](const exchange::DriveWheels& each) {
            return wheels().drive_wheels(each.speeds, as_of);
          },
          [&](const exchange::Send& message) { return send(message); },
          [&](const exchange::Invalidate& routes) {
            router_.invalidate(routes.topic, routes.destination);
            return Done{};
          },
          [&](const exchange::SetTimer& timer) {
            set_timer(timer);
            return Done{};
          },
          [&](const exchange::SetRadio& radio) {
            ports_.link.set_radio(radio.on);
            return Done{};
          },
          [&](const exchange::SetState& state) {
            set_state(state.name);
            return Done{};
          },
          [&](const exchange::Log& line) {
            log::write(line.level, now(), name() + "/controller", line.text);
            return Done{};
          },
          [](const exchange::ControllerFailed&) { return Done{}; },
          [&](const exchange::Record& value) { return record(value); },
      },
      action.what);
}

Drive& AgentCore::wheels() {
  // Without wheels the limits of the session make validate() refuse wheel commands.
  BARAKA_CHECK(ports_.drive != nullptr);
  return *ports_.drive;
}

Result<void> AgentCore::send(const exchange::Send& message) {
  if (auto admitted = topics_.admit(message.topic); !admitted) return admitted;
  sent_[++last_message_] = message.id;
  const auto given = priorities_.find(message.topic);
  const Message numbered{.source = id(),
                         .destination = message.destination,
                         .id = last_message_,
                         .topic = message.topic,
                         .payload = message.payload,
                         .priority = given != priorities_.end() ? given->second : message.priority};
  ports_.observer.on_message_sent(now(), numbered);
  router_.send(numbered);
  return {};
}

Result<void> AgentCore::record(const exchange::Record& record) {
  if (auto admitted = recorded_.admit(record.name); !admitted) return admitted;
  log::debug(now(), name(), "records {} = {}", record.name, record.value);
  const Time at = std::clamp(record.at, Time{}, now());
  ports_.observer.on_record(at, id(), record.name, record.value);
  return {};
}

void AgentCore::set_timer(const exchange::SetTimer& timer) {
  Timers::Handle& pending = timers_[timer.timer];
  if (pending != 0) ports_.timers.cancel(pending);
  // The action may take effect after the requested time; then the timer is due at once.
  pending = ports_.timers.schedule(std::max(timer.at, now()), [this, number = timer.timer] {
    add(event(exchange::TimerDue{number}));
  });
}

void AgentCore::set_state(const std::string& state) {
  last_state_ = state;
  ports_.observer.on_state(now(), id(), state);
  ports_.listener.on_state(id(), state);
}

void AgentCore::halt() {
  if (ports_.drive != nullptr) ports_.drive->halt();
}

void AgentCore::on_message(Message message, int transmissions) {
  ports_.observer.on_message_delivered(now(), id(), message, transmissions);
  add(event(exchange::MessageArrived{std::move(message)}));
}

void AgentCore::on_fate(MessageId message, Fate fate) {
  ports_.observer.on_fate(now(), id(), message, fate);
  const auto sent = sent_.extract(message);
  if (sent.empty()) return;  // the message was sent by an earlier controller
  add(event(exchange::Notice{sent.mapped(), fate}));
}

void AgentCore::on_route_change(const RouteChange& change) {
  ports_.observer.on_route_change(now(), id(), change);
  if (is_connected() && is_watched(change.route.topic)) inbox_.add(now(), change);
}

void AgentCore::on_neighbour(const Neighbour& neighbour) {
  if (!is_connected() || !wants_.neighbours) return;
  inbox_.add(now(), neighbour);
  if (told_.insert(neighbour.id).second) add(event(exchange::LinkChanged{}));
}

void AgentCore::on_neighbour_lost(AgentId neighbour) {
  if (!is_connected() || !wants_.neighbours || told_.erase(neighbour) == 0) return;
  inbox_.add_lost(now(), neighbour);
  add(event(exchange::LinkChanged{}));
}

void AgentCore::on_discovery(std::string_view topic, AgentId destination, Duration took,
                             bool found) {
  log::debug(now(), name(), "discovery of {} for '{}': {} after {:.9f} s", destination.value, topic,
             found ? "found" : "given up", to_seconds(took));
  ports_.observer.on_discovery(now(), id(), {topic, destination, took, found});
}

void AgentCore::on_message_end(AgentId sent_by, MessageId message, std::string_view,
                               Verdict verdict) {
  ports_.observer.on_message_end(now(), id(), sent_by, message, verdict);
}

void AgentCore::on_protocol_event(routing::ProtocolEvent event) {
  ports_.observer.on_protocol_event(id(), event);
}

}  // namespace hal::node::agent
