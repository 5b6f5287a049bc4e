#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>
#include <string>

#include "gateway/exchange/server.h"
#include "gateway/runtime/controller_options.h"
#include "hal/api/controller.h"
#include "hal/node/exchange/session.h"
#include "hal/node/exchange/step.h"

/// Long: only a defect lets a test wait for it.
inline constexpr hal::Duration kPatience = std::chrono::seconds{30};

/// A mote's controller that names each of its callbacks as a state.
class EchoMote : public hal::Controller {
 public:
  EchoMote(hal::Mote& mote, const hal::Parameters& parameters) : mote_(mote) { (void)parameters; }
  void start() override { mote_.state("started"); }
  void step() override { mote_.state("stepped " + std::to_string(++steps_)); }
  void receive(const hal::Message& message) override {
    if (message.topic == "throw") throw std::runtime_error("asked to throw");
    mote_.state("received " + message.topic);
  }
  void stop() override { mote_.state("stopped"); }

 private:
  hal::Mote& mote_;
  int steps_ = 0;
};

inline hal::ControllerKind echo_kind() {
  return {.name = "echo",
          .wants = {},
          .parameters = {{"gain", "1", 1.0, 0.0, 10.0, "does nothing"}},
          .make_for_mote = hal::make_for_mote<EchoMote>};
}

/// The options of a process that asks for one agent.
inline gateway::runtime::ControllerOptions options_for(int domain, const std::string& agent,
                                                       const std::string& name) {
  gateway::runtime::ControllerOptions options;
  options.agents = {agent};
  options.domain = domain;
  options.name = name;
  return options;
}

/// What a server grants in these tests: mote 1, "m1".
inline hal::node::exchange::Session session_for(const hal::node::exchange::Hello& hello,
                                                std::uint64_t run) {
  hal::node::exchange::AgentSession agent;
  agent.agent = hal::AgentId{1};
  agent.name = "m1";
  agent.control_period = std::chrono::milliseconds{100};
  hal::node::exchange::Session session;
  session.instance = hello.instance;
  session.run = run;
  session.agents = {agent};
  return session;
}

inline hal::node::exchange::Step step_with(hal::node::exchange::Event::What what,
                                           std::uint64_t sequence) {
  hal::node::exchange::Event event;
  event.agent = hal::AgentId{1};
  event.what = std::move(what);
  hal::node::exchange::Step step;
  step.sequence = sequence;
  step.events = {event};
  return step;
}

/// The first Hello that reaches the server within 30 s: the machine may be busy.
inline hal::node::exchange::Hello first_hello(gateway::exchange::Server& server) {
  auto hellos = server.hellos(std::chrono::seconds{30});
  if (hellos.empty()) throw std::runtime_error("no Hello came");
  return hellos.front();
}

/// Sends a Step and waits for the answer.
inline hal::Result<hal::node::exchange::Reply> exchange_step(
    gateway::exchange::ProcessLink& link, const hal::node::exchange::Step& step) {
  if (auto begun = link.begin(step); !begun) return tl::unexpected(begun.error());
  return link.finish();
}
