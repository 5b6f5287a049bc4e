#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sim/agents/simulation.h"
#include "tests/support/no_pace.h"
#include "tests/support/printers.h"
#include "tests/support/scripted_port.h"

namespace tests {

using namespace std::chrono_literals;
using hal::AgentId;
using hal::Time;
using hal::node::exchange::Action;
using hal::node::exchange::Cause;
using hal::node::exchange::DriveBody;
using hal::node::exchange::Event;
using hal::node::exchange::Send;
using hal::node::exchange::Step;
using sim::agents::Outcome;
using sim::agents::SimulationConfig;

inline constexpr AgentId kA{1}, kB{2};

inline Action state(const std::string& text) {
  return {.what = hal::node::exchange::SetState{text}};
}

/// The message "test" without content, but for what is said.
inline Action send(AgentId destination, hal::MessageId id = 1, hal::Bytes payload = {}) {
  return {
      .what = Send{
          .id = id, .destination = destination, .topic = "test", .payload = std::move(payload)}};
}

inline Action drive(double vx) { return {.what = DriveBody{{.vx = vx}}}; }

/// When actions took effect.
class Effects final : public sim::agents::Observer {
 public:
  void on_action(Time at, const Action& action) override { actions.emplace_back(at, action.what); }
  void on_body_lost(const sim::physics::LostBody& body) override { lost.push_back(body.agent); }
  std::vector<std::pair<Time, Action::What>> actions;
  std::vector<AgentId> lost;
};

/// Two motes next to each other, with an ideal radio.
class TwoMotes : public testing::Test {
 protected:
  TwoMotes() {
    config.control_phase = sim::agents::ControlPhase::kAligned;
    config.radio = sim::radio::profile_defaults(sim::radio::Profile::kIdeal);
    for (const AgentId id : {kA, kB}) {
      config.agents.push_back({.id = id,
                               .name = id == kA ? "a" : "b",
                               .pose = {10.0 * id.value, 0, 0},
                               .body = hal::node::devices::MoteDescription{},
                               .program = {},
                               .parameters = {}});
    }
  }

  Outcome run(Time until, ScriptedPort::Rule rule, const hal::Wants& wants = {}) {
    port = std::make_shared<ScriptedPort>(std::move(rule));
    sim::agents::Simulation simulation(config, {&effects});
    simulation.connect(port, {kA, kB}, wants);
    NoPace pace;
    return simulation.run(until, pace);
  }

  SimulationConfig config;
  std::shared_ptr<ScriptedPort> port;
  Effects effects;
};

inline std::vector<Action> nothing(const Event&) { return {}; }

}  // namespace tests
