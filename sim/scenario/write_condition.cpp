// Conditions as files have them.
#include <algorithm>
#include <limits>
#include <string_view>

#include "sim/scenario/agent_names.h"
#include "sim/scenario/condition_section.h"

namespace sim::scenario {
namespace {

using agents::ApartBy;
using agents::Area;
using agents::BatteryLevel;
using agents::Combination;
using agents::Condition;
using agents::CountOf;
using agents::InArea;
using agents::InState;
using agents::Subjects;
using agents::TimeReached;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::int64_t kMostWritten = 1'000'000'000'000;
constexpr auto kNoLimit = std::numeric_limits<std::int64_t>::max();

std::string_view key_of(Subjects::Quantifier quantifier) {
  switch (quantifier) {
    case Subjects::Quantifier::kOne:
      return "agent";
    case Subjects::Quantifier::kAny:
      return "any";
    case Subjects::Quantifier::kAll:
      return "all";
  }
  return {};
}

void write_subjects(Writer& out, const Subjects& who) {
  out.text(key_of(who.quantifier), who.whose);
}

template <class Limited>
void write_limits(Writer& out, std::string_view unit, const Limited& limited) {
  if (limited.above > -kInfinity) out.number("above", limited.above, unit);
  if (limited.below < kInfinity) out.number("below", limited.below, unit);
}

/// Writes one kind of condition each.
struct WriteCondition {
  Writer& out;
  const Scenario& scenario;

  void operator()(const TimeReached& c) const { out.duration("time", c.at); }
  void operator()(const InState& c) const {
    write_subjects(out, c.who);
    out.text("state", c.state);
  }
  void operator()(const ApartBy& c) const {
    out.texts("distance", {declared(c.a, scenario).name, declared(c.b, scenario).name});
    write_limits(out, "m", c);
  }
  void operator()(const InArea& c) const {
    write_subjects(out, c.who);
    out.open("area");
    if (const auto* circle = std::get_if<Area::Circle>(&c.area.shape)) {
      out.numbers("centre", {circle->centre.x, circle->centre.y}, "m");
      out.number("radius", circle->radius, "m");
    } else {
      const auto& box = std::get<Area::Box>(c.area.shape);
      out.numbers("from", {box.low.x, box.low.y}, "m");
      out.numbers("to", {box.high.x, box.high.y}, "m");
    }
    out.close();
  }
  void operator()(const BatteryLevel& c) const {
    write_subjects(out, c.who);
    out.open("battery");
    write_limits(out, "1", c);
    out.close();
  }
  void operator()(const CountOf& c) const {
    out.text("count", c.who.whose);
    out.text(c.state.empty() ? "received" : "state", c.state.empty() ? c.topic : c.state);
    if (c.at_least > 0) out.integer("at_least", c.at_least);
    if (c.at_most < kNoLimit || c.at_least == 0)
      out.integer("at_most", std::min(c.at_most, kMostWritten));
  }
  void operator()(const Combination& c) const {
    if (c.kind == Combination::Kind::kNone) {
      out.open("not");
      write_condition(out, c.parts.front(), scenario);
      return out.close();
    }
    out.open_list(c.kind == Combination::Kind::kAll ? "all_of" : "any_of");
    for (const Condition& part : c.parts) {
      out.open_item();
      write_condition(out, part, scenario);
      out.close();
    }
    out.close();
  }
};

}  // namespace

void write_condition(Writer& out, const Condition& condition, const Scenario& scenario) {
  std::visit(WriteCondition{out, scenario}, condition.what);
  if (condition.hold > hal::Duration::zero()) out.duration("for", condition.hold);
}

}  // namespace sim::scenario
