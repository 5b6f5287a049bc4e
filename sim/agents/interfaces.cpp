#include "sim/agents/interfaces.h"

#include <algorithm>
#include <utility>

#include "hal/types/check.h"
#include "hal/types/log.h"

namespace sim::agents {
namespace {

/// Frames that may have been read before the run takes them in. More stay where they are, in the
/// interfaces' own queues.
constexpr std::size_t kMostHeld = 16'384;
/// Taken at a time: then the run goes on.
constexpr std::size_t kMostAtOnce = 1024;

}  // namespace

Interfaces::Interfaces(const SimulationConfig& config, radio::RadioNetwork& radio, const Home& home)
    : home_(home), entering_(config.lateness_limit), leaving_(config.lateness_limit) {
  for (const AgentConfig& agent : config.agents) {
    if (!agent.network) continue;
    ports_.push_back(
        {.agent = agent.id,
         .door = air_door(agent.name),
         .interface = std::make_unique<air::Interface>(agent.id, radio.sap(agent.id), *this)});
  }
  for (std::size_t i = 0; i < ports_.size(); ++i) {
    ports_[i].capacity = ports_[i].interface->room();
    home_.outside.open(ports_[i].door, [this, i](std::span<const std::uint8_t> ethernet) {
      Port& port = ports_[i];
      port.held -= std::min<std::size_t>(port.held, 1);  // none in a repetition
      port.interface->send(ethernet);
    });
  }
}

void Interfaces::connect(air::FrameSink& sink, air::FrameSource& source) {
  sink_ = &sink;
  source_ = &source;
}

Interfaces::Port& Interfaces::port_of(hal::AgentId agent) {
  const auto port = std::ranges::lower_bound(ports_, agent, {}, &Port::agent);
  BARAKA_CHECK(port != ports_.end() && port->agent == agent);
  return *port;
}

void Interfaces::follow(FollowedClock& clock) {
  clock_ = &clock;
  if (!is_connected()) return;
  const hal::Time start = clock.now();
  source_->read(kMostHeld, [&](air::SentFrame frame) { enter(start, std::move(frame)); });
}

void Interfaces::take_frames(hal::Time last) {
  const std::size_t held = home_.outside.held();
  if (held >= kMostHeld) return;
  hal::Time previous = last + hal::Duration{1};
  source_->read(std::min(kMostAtOnce, kMostHeld - held), [&](air::SentFrame frame) {
    previous = std::max(clock_->now(), previous);
    enter(previous, std::move(frame));
  });
}

/// Before the clock started nothing could be late.
void Interfaces::enter(hal::Time at, air::SentFrame&& frame) {
  entering_.add(at - std::max(frame.since, hal::Time{}));
  Port& port = port_of(frame.agent);
  ++port.held;
  home_.outside.put_at(at, port.door, std::move(frame.ethernet));
}

void Interfaces::tell_room() {
  for (const Port& port : ports_) {
    const std::size_t room = port.interface->room();
    sink_->on_room(port.agent,
                   {.free = room - std::min(room, port.held), .capacity = port.capacity});
  }
}

void Interfaces::on_entered(hal::AgentId agent, const radio::MacRequest& request) {
  home_.observer.on_air_entered(home_.events.now(), agent, request);
}

void Interfaces::on_left(hal::AgentId agent, const radio::MacIndication& indication,
                         std::span<const std::uint8_t> ethernet) {
  const hal::Time at = home_.events.now();
  home_.observer.on_air_left(at, agent, indication);
  if (sink_ == nullptr) return;
  sink_->on_frame(agent, at, ethernet);
  if (clock_ != nullptr) leaving_.add(clock_->now() - at);
}

void Interfaces::on_refused(hal::AgentId agent, air::Refusal refusal, std::size_t bytes) {
  const hal::Time now = home_.events.now();
  ++refused_[static_cast<std::size_t>(refusal)];
  hal::log::debug(now, port_of(agent).door, "a frame of {} bytes is refused: {}", bytes,
                  air::name(refusal));
  home_.observer.on_air_refused(now, agent, refusal, bytes);
}

AirSummary Interfaces::summary() const {
  AirSummary summary{.entering = entering_.summary(), .leaving = leaving_.summary()};
  for (std::size_t i = 0; i < refused_.size(); ++i) {
    if (refused_[i] > 0) {
      summary.refused.emplace_back(air::name(static_cast<air::Refusal>(i)), refused_[i]);
    }
  }
  summary.has_seen_tcp =
      std::ranges::any_of(ports_, [](const Port& port) { return port.interface->has_seen_tcp(); });
  return summary;
}

}  // namespace sim::agents
