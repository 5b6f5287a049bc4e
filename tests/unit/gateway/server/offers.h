#pragma once

#include <fmt/core.h>

#include <string>
#include <utility>
#include <vector>

#include "hal/node/exchange/ports.h"

/// Agents as a host offers them: motes m1, m2, m3 for help_mote, a robot r0 with infrared for any.
inline std::vector<hal::node::exchange::AgentOffer> sample_offers() {
  std::vector<hal::node::exchange::AgentOffer> offers;
  for (std::uint16_t address = 1; address <= 3; ++address) {
    hal::node::exchange::AgentOffer offer;
    offer.session.agent = hal::AgentId{address};
    offer.session.name = fmt::format("m{}", address);
    offer.program = "help_mote";
    offers.push_back(offer);
  }
  hal::node::exchange::AgentOffer robot;
  robot.session.agent = hal::AgentId{4};
  robot.session.name = "r0";
  robot.session.kind = hal::AgentKind::kRobot;
  robot.session.channels.resize(2);
  robot.session.channels[0].name = "infrared";
  robot.session.channels[1].name = "odometry";
  robot.session.limits.body_to_wheel.resize(3);
  offers.push_back(robot);
  return offers;
}

/// A Hello of help_mote that asks for motes.
inline hal::node::exchange::Hello hello_for(const std::string& process,
                                            std::vector<std::string> patterns) {
  hal::node::exchange::Hello hello;
  hello.process = process;
  hello.instance = process + "/1";
  hello.program = "help_mote";
  hello.patterns = std::move(patterns);
  return hello;
}
