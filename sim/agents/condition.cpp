#include "sim/agents/condition.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sim::agents {
namespace {

using AgentNames = std::vector<std::pair<hal::AgentId, std::string>>;

std::string text_of(const Subjects& who) {
  switch (who.quantifier) {
    case Subjects::Quantifier::kOne:
      return who.whose;
    case Subjects::Quantifier::kAny:
      return fmt::format("any of '{}'", who.whose);
    case Subjects::Quantifier::kAll:
      return fmt::format("all of '{}'", who.whose);
  }
  return {};
}

std::string_view word_of(Combination::Kind kind) {
  switch (kind) {
    case Combination::Kind::kAll:
      return "all of";
    case Combination::Kind::kAny:
      return "any of";
    case Combination::Kind::kNone:
      return "not";
  }
  return {};
}

std::string limits_text(double above, double below, std::string_view unit) {
  std::string text;
  if (std::isfinite(above)) text += fmt::format(" above {}{}", above, unit);
  if (std::isfinite(below)) text += fmt::format(" below {}{}", below, unit);
  return text;
}

/// Converts each kind of condition to text.
struct ToText {
  const AgentNames& names;

  std::string name_of(hal::AgentId agent) const {
    const auto found = std::ranges::find(names, agent, &AgentNames::value_type::first);
    return found == names.end() ? std::to_string(agent.value) : found->second;
  }

  std::string operator()(const TimeReached& c) const {
    return fmt::format("time {} s", hal::to_seconds(c.at));
  }
  std::string operator()(const InState& c) const {
    return fmt::format("{} in state {}", text_of(c.who), c.state);
  }
  std::string operator()(const ApartBy& c) const {
    return fmt::format("distance of {} and {}{}", name_of(c.a), name_of(c.b),
                       limits_text(c.above, c.below, " m"));
  }
  std::string operator()(const InArea& c) const {
    return fmt::format("{} in the area", text_of(c.who));
  }
  std::string operator()(const BatteryLevel& c) const {
    return fmt::format("battery of {}{}", text_of(c.who), limits_text(c.above, c.below, ""));
  }
  std::string operator()(const CountOf& c) const {
    std::string text = c.state.empty()
                           ? fmt::format("messages '{}' got by '{}'", c.topic, c.who.whose)
                           : fmt::format("count of '{}' in state {}", c.who.whose, c.state);
    if (c.at_least > 0) text += fmt::format(" at least {}", c.at_least);
    if (c.at_most < std::numeric_limits<std::int64_t>::max())
      text += fmt::format(" at most {}", c.at_most);
    return text;
  }
  std::string operator()(const Combination& c) const {
    std::string text = fmt::format("{} (", word_of(c.kind));
    for (std::size_t i = 0; i < c.parts.size(); ++i) {
      text += (i == 0 ? "" : "; ") + to_text(c.parts[i], names);
    }
    return text + ")";
  }
};

}  // namespace

bool Area::contains(hal::Vec2 point) const {
  if (const auto* circle = std::get_if<Circle>(&shape)) {
    const hal::Vec2 from = point - circle->centre;
    return hal::dot(from, from) <= circle->radius * circle->radius;
  }
  const Box& box = std::get<Box>(shape);
  return point.x >= box.low.x && point.x <= box.high.x && point.y >= box.low.y &&
         point.y <= box.high.y;
}

std::string to_text(const Condition& condition, const AgentNames& names) {
  std::string text = std::visit(ToText{names}, condition.what);
  if (condition.hold > hal::Duration::zero()) {
    text += fmt::format(" for {} s", hal::to_seconds(condition.hold));
  }
  return text;
}

}  // namespace sim::agents
