#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hal/types/geometry.h"
#include "hal/types/quantity.h"
#include "sim/agents/simulation_config.h"

namespace results::coverage {

/// A rectangle of the floor, world frame, m.
struct Area {
  hal::Vec2 low, high;
};

struct CoverageOptions {
  hal::Metres step{0.5};  ///< Between the points, > 0.
  std::optional<hal::Metres>
      at{};                    ///< Of the receiving antenna above the ground; default: the radio's.
  std::optional<Area> area{};  ///< Default: around all walls and agents, with a margin of 1 m.
  std::string of{};            ///< Pattern of agents; empty: the access points.
  std::uint32_t bytes = 1500;  ///< Length of the PSDU for the rate.
};

/// Largest packet error rate at which a rate counts as usable.
inline constexpr double kUsableLoss = 0.1;

/// Most points of a map times transmitters.
inline constexpr double kMostPoints = 20e6;

/// An agent that transmits, where it stands at the start.
struct Transmitter {
  std::string name;
  hal::Vec3 antenna;  ///< m, world frame
};

/// What a receiver has at one point.
struct Spot {
  std::size_t best = 0;       ///< Index of the transmitter that is received with the most power.
  hal::Dbm rssi{};            ///< From it.
  hal::Decibels snr{};        ///< In 20 MHz, without interference.
  hal::BitsPerSecond rate{};  ///< Highest usable rate; 0: none.
};

/// Radio coverage of a floor: mean received powers, that is without shadowing and fading, by the
/// radio's law of distance, the walls and the antennas' gains.
struct Coverage {
  Area area;
  double step = 0;    ///< m
  double height = 0;  ///< m above the ground
  std::size_t columns = 0, rows = 0;
  std::vector<Transmitter> transmitters;
  std::vector<double> rates;  ///< Mb/s, that some spot could have, ascending.
  hal::Dbm sensitivity{};
  std::uint32_t bytes = 0;
  std::vector<Spot> spots;   ///< Row by row, from the lowest x and y.
  std::vector<double> rssi;  ///< dBm, for each spot from each transmitter.

  hal::Vec2 centre(std::size_t column, std::size_t row) const {
    return {area.low.x + (static_cast<double>(column) + 0.5) * step,
            area.low.y + (static_cast<double>(row) + 0.5) * step};
  }
  const Spot& at(std::size_t column, std::size_t row) const {
    return spots[row * columns + column];
  }
  bool is_covered(const Spot& spot) const { return spot.rssi >= sensitivity; }
};

/// Agents that are access points: of the radio, or of some agent.
std::vector<hal::AgentId> access_points_of(const sim::agents::SimulationConfig& config);

/// Around all walls and agents, with a margin of 1 m. @pre there are agents.
Area area_around(const sim::agents::SimulationConfig& config);

/// @throws std::runtime_error  no agent to look at, a radio without power levels, too many points.
Coverage coverage_of(const sim::agents::SimulationConfig& config, const CoverageOptions& options);

}  // namespace results::coverage
