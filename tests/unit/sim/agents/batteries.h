#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "hal/node/devices/channels.h"
#include "sim/radio/mac/frame.h"
#include "tests/unit/sim/agents/two_motes.h"

namespace tests {

inline hal::node::devices::Battery battery(double joules) {
  hal::node::devices::Battery one;
  one.capacity = joules;
  one.full_voltage = one.empty_voltage = 10;
  return one;
}

/// One that switches its agent off. @param joules  when full
inline hal::node::devices::Battery last_battery(double joules) {
  hal::node::devices::Battery one = battery(joules);
  one.when_empty = hal::node::devices::WhenEmpty::kOff;
  return one;
}

/// What became of the air, and where the first agent is.
class Seen final : public sim::agents::Observer {
 public:
  struct Air {
    Time start, end;
    AgentId from;
  };
  void on_body(Time, AgentId agent, const sim::agents::BodyState& body) override {
    if (agent == kA) track.push_back(body.x);
  }
  void on_frame_start(Time at, const sim::radio::Frame& frame) override {
    frames.push_back({at, at + frame.airtime, frame.transmitter});
  }
  void on_frame_cut(Time at, const sim::radio::Frame&) override { cuts.push_back(at); }
  void on_reception(Time at, const sim::radio::Frame&, AgentId, hal::Verdict verdict,
                    double) override {
    receptions.emplace_back(at, verdict);
  }
  /// s on the air by one, before a time.
  double airtime(AgentId from, Time until) const {
    hal::Duration sum{};
    for (const Air& frame : frames)
      if (frame.from == from && frame.start < until) sum += frame.end - frame.start;
    return hal::to_seconds(sum);
  }

  std::vector<Air> frames;
  std::vector<Time> cuts;
  std::vector<std::pair<Time, hal::Verdict>> receptions;
  std::vector<double> track;  ///< m, at control instants
};

/// Two motes, next to each other, with batteries.
class Batteries : public TwoMotes {
 protected:
  void give(AgentId agent, const hal::node::devices::Battery& one) {
    std::visit([&](auto& body) { body.sensors = {one}; }, config.agents.at(agent.value - 1u).body);
  }

  Outcome run(Time until, ScriptedPort::Rule rule = nothing,
              const hal::Wants& wants = {.channels = {}, .optional = {"battery"}}) {
    port = std::make_shared<ScriptedPort>(std::move(rule));
    seen = {};
    sim::agents::Simulation simulation(config, {&effects, &seen});
    simulation.connect(port, {kA, kB}, wants);
    NoPace pace;
    const Outcome outcome = simulation.run(until, pace);
    for (const AgentId agent : {kA, kB}) used[agent] = simulation.use(agent);
    return outcome;
  }

  std::int64_t messages() const {
    return std::ranges::count(port->of(Cause::kMessage), kB, &Event::agent);
  }

  /// How long the radio was on.
  hal::Duration on_air(AgentId agent) const {
    const sim::radio::RadioUse& use = used.at(agent).radio;
    return use.transmitting + use.receiving + use.listening;
  }

  /// J that a battery's loads take, by how long the radio was in each state.
  double load_of(const hal::node::devices::Battery& one, AgentId agent) const {
    const sim::radio::RadioUse& use = used.at(agent).radio;
    return one.idle_power * hal::to_seconds(on_air(agent)) +
           one.radio.transmit * hal::to_seconds(use.transmitting) +
           one.radio.receive * hal::to_seconds(use.receiving) +
           one.radio.listen * hal::to_seconds(use.listening);
  }

  /// The last reading of a channel that a controller got, lost or not.
  std::optional<hal::node::exchange::Reading> last_reading(
      AgentId agent, std::uint16_t channel = hal::node::devices::kFirstSensor) const {
    std::optional<hal::node::exchange::Reading> last;
    for (const Step& step : port->steps)
      for (const Event& event : step.events)
        for (const auto& reading : event.readings)
          if (event.agent == agent && reading.channel == channel) last = reading;
    return last;
  }

  /// Of the gauge: charge, voltage, current, energy, capacity.
  std::vector<double> last(AgentId agent) const {
    const auto reading = last_reading(agent);
    return reading ? reading->values : std::vector<double>{};
  }

  Seen seen;
  std::map<AgentId, sim::agents::AgentUse> used;
};

/// The first agent sends a message to the second in each control cycle.
inline std::vector<Action> send_always_with(const Event& event, hal::Bytes payload) {
  if (event.agent != kA || event.cause() != Cause::kControl) return {};
  const auto id = static_cast<hal::MessageId>(event.time.time_since_epoch() / 100ms + 1);
  return {send(kB, id, std::move(payload))};
}
inline std::vector<Action> send_always(const Event& event) { return send_always_with(event, {}); }

inline constexpr double kExact = 1e-12;  ///< Relative: what a battery has given in all.

class EmptyBattery : public Batteries {
 protected:
  void at(hal::Duration when, decltype(sim::agents::ScriptedAction::what) what, AgentId agent) {
    config.script.push_back({sim::agents::AtTime{when}, {{std::move(what), "x", {agent}, {}}}, {}});
  }
  /// 802.11b, without a search for routes.
  void use_dcf() {
    config.radio = sim::radio::profile_defaults(sim::radio::Profile::kIeee80211b);
    for (auto& agent : config.agents) agent.routing = hal::node::routing::Algorithm::kNone;
  }
};

/// 0.5 W idle, and 0.5 W while its radio listens.
inline hal::node::devices::Battery one_watt(double joules) {
  hal::node::devices::Battery one = last_battery(joules);
  one.idle_power = one.radio.listen = 0.5;
  return one;
}

}  // namespace tests
