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

/// Of whom a condition speaks: of one agent, of any or of all of some.
struct Subjects {
  enum class Quantifier : std::uint8_t { kOne, kAny, kAll };
  Quantifier quantifier = Quantifier::kOne;
  std::string whose;                 ///< Name, or pattern of names, for people.
  std::vector<hal::AgentId> agents;  ///< Those that it names, at least one.
};

/// From this time on.
struct TimeReached {
  hal::Duration at{};
};

/// Their controllers are in this state. Seen at once, also if it lasts no time.
struct InState {
  Subjects who;
  std::string state;
};

/// True distance between two agents, m.
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

/// Part of the plane, m, world frame: a circle, or from one corner to the other.
struct Area {
  using Circle = CircularArea;
  using Box = BoxArea;
  std::variant<Circle, Box> shape{};

  bool contains(hal::Vec2 point) const;
};

/// They are inside the area, its edge included.
struct InArea {
  Subjects who;
  Area area;
};

/// State of charge of their batteries, 0 .. 1; the first battery of each. Seen at their control
/// instants.
struct BatteryLevel {
  Subjects who;
  double above = -std::numeric_limits<double>::infinity();
  double below = std::numeric_limits<double>::infinity();
};

/// How many of the agents are in a state, or how many messages of a class all of them together have
/// got.
struct CountOf {
  Subjects who;
  std::string state;  ///< Empty: messages are counted …
  std::string topic;  ///< … of this class.
  std::int64_t at_least = 0;
  std::int64_t at_most = std::numeric_limits<std::int64_t>::max();
};

struct Condition;

/// Of other conditions.
struct Combination {
  enum class Kind : std::uint8_t { kAll, kAny, kNone };
  Kind kind = Kind::kAll;
  std::vector<Condition> parts;  ///< At least one.
};

/// Something that holds or does not at each time of a run, by the true state of the world. It
/// depends on no random stream, and nothing depends on whether it is watched.
struct Condition {
  std::variant<TimeReached, InState, ApartBy, InArea, BatteryLevel, CountOf, Combination> what;
  hal::Duration hold{};  ///< It must have held for so long without a break; 0: it holds.
  std::string place;     ///< "file:line:column".
};

/// For people: "any of 'r*' in state ARRIVED for 5 s".
/// @param name  of an agent.
std::string to_text(const Condition& condition,
                    const std::vector<std::pair<hal::AgentId, std::string>>& names);

}  // namespace sim::agents
