#pragma once

#include <string>
#include <utility>

#include "sim/agents/simulation_config.h"

namespace tests {

/// A floor of 20 m x 12 m with two access points, walls of brick, concrete and wood, and a law.
inline sim::agents::SimulationConfig floor_with(const sim::radio::MultiWallConfig& law) {
  sim::agents::SimulationConfig config;
  config.radio = sim::radio::profile_defaults(sim::radio::Profile::kIeee80211g);
  auto& dcf = *dcf_of(config.radio);
  dcf.propagation.chain = {law};
  dcf.propagation.antenna_height = hal::Metres{1};
  dcf.bss.access_points = {"ap0", "ap1"};
  const auto wall = [&](hal::Vec2 at, hal::Vec2 size, const char* material) {
    config.walls.push_back({.name = "w" + std::to_string(config.walls.size()),
                            .centre = {at.x, at.y, 1.5},
                            .size = {size.x, size.y, 3},
                            .material = material});
  };
  wall({5, 3}, {0.2, 6}, "brick");
  wall({10, 8}, {0.2, 8}, "concrete");
  wall({15, 4}, {0.2, 8}, "wood");
  wall({8, 6}, {6, 0.2}, "brick");
  wall({16, 9}, {8, 0.2}, "wood");
  std::uint16_t id = 0;
  for (const auto& [name, place] : {std::pair{"ap0", hal::Vec2{1, 1}}, {"ap1", {18, 11}}}) {
    sim::agents::AgentConfig agent{.id = hal::AgentId{++id},
                                   .name = name,
                                   .pose = {place.x, place.y, 0},
                                   .body = sim::agents::Station{},
                                   .program = {},
                                   .parameters = {}};
    agent.radio.antenna_height = hal::Metres{2.5};
    config.agents.push_back(std::move(agent));
  }
  return config;
}

}  // namespace tests
