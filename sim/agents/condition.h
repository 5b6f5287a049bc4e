#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/geometry.h"
#include "hal/types/time.h"

namespace sim::agents {

/// The agents that a condition is about: one agent, or any or all of several.
struct Subjects {
  enum class Quantifier : std::uint8_t { kOne, kAny, kAll };
  Quantifier quantifier = Quantifier::kOne;
  std::string whose;                 ///< Name, or pattern of names, for messages.
  std::vector<hal::AgentId> agents;  ///< The agents named, at least one.
};

/// Holds from this time on.
struct TimeReached {
  hal::Duration at{};
};

/// The controllers of the agents are in this state. Evaluated at each change of state, even if the
/// state lasts no time.
struct InState {
  Subjects who;
  std::string state;
};

/// The true distance between two agents is within these limits [m].
struct ApartBy {
  hal::AgentId a, b;
  double above = -std::numeric_limits<double>::infinity();
  double below = std::numeric_limits<double>::infinity();
};

struct CircularArea {
  hal::Vec2 centre{};
  double radius = 0;
};
struct BoxArea {
  hal::Vec2 low{}, high{};
};

/// Part of the plane in the world frame: a circle, or a box given by two corners [m].
struct Area {
  using Circle = CircularArea;
  using Box = BoxArea;
  std::variant<Circle, Box> shape{};

  bool contains(hal::Vec2 point) const;
};

/// The agents are inside the area or on its edge.
struct InArea {
  Subjects who;
  Area area;
};

/// The state of charge (0 .. 1) of the first battery of the agents is within these limits.
/// Evaluated at their control instants.
struct BatteryLevel {
  Subjects who;
  double above = -std::numeric_limits<double>::infinity();
  double below = std::numeric_limits<double>::infinity();
};

/// Number of agents in a state, or number of messages of a class that all the agents together have
/// received.
struct CountOf {
  Subjects who;
  std::string state;  ///< Empty: messages are counted.
  std::string topic;  ///< Class of messages, if `state` is empty.
  std::int64_t at_least = 0;
  std::int64_t at_most = std::numeric_limits<std::int64_t>::max();
};

struct Condition;

/// Logical combination of conditions.
struct Combination {
  enum class Kind : std::uint8_t { kAll, kAny, kNone };
  Kind kind = Kind::kAll;
  std::vector<Condition> parts;  ///< At least one.
};

/// A condition on the true state of the world, which holds or does not hold at each time of a run.
/// It draws no random numbers, and watching it does not change the run.
struct Condition {
  std::variant<TimeReached, InState, ApartBy, InArea, BatteryLevel, CountOf, Combination> what;
  hal::Duration hold{};  ///< Time for which it must have held without interruption; 0: none.
  std::string place;     ///< "file:line:column".
};

/// Text for messages: "any of 'r*' in state ARRIVED for 5 s".
/// @param names  names of the agents.
std::string to_text(const Condition& condition,
                    const std::vector<std::pair<hal::AgentId, std::string>>& names);

}  // namespace sim::agents
