#include "sim/scenario/condition_section.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <limits>
#include <string>
#include <utility>

#include "sim/scenario/agent_names.h"
#include "sim/scenario/given_keys.h"

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

constexpr Range kConditionTime{0, hal::config::kLongestDuration};  // s
constexpr Range kApart{0, 1e9};                                    // m
constexpr std::int64_t kMostCounted = 1'000'000'000'000;

Subjects read_subjects(Mapping& in, const Scenario& scenario) {
  const GivenKeys keys(in);
  Subjects who;
  std::string key;
  if (keys.has("any")) {
    key = "any";
    who.quantifier = Subjects::Quantifier::kAny;
    who.whose = in.text({"any", "At least one of the agents with such names.", "'NAME*'"});
  }
  if (keys.has("all") && (key.empty() || keys.is_survey())) {
    key = "all";
    who.quantifier = Subjects::Quantifier::kAll;
    who.whose = in.text({"all", "Each of the agents with such names.", "'NAME*'"});
  }
  if (key.empty() || keys.is_survey()) {
    key = "agent";
    who.whose =
        in.text({"agent", "The agent that is meant; or any, or all, of a pattern.", "NAME0"});
  }
  if (!who.whose.empty()) who.agents = agents_meant(in, key, who.whose, scenario);
  return who;
}

/// `above` and `below`, at least one of them.
template <class Limited>
void read_limits(Mapping& in, std::string_view unit, Range range, Limited& limited) {
  const bool is_part = unit == "1";
  const GivenKeys keys(in);
  const bool has_above = keys.has("above"), has_below = keys.has("below");
  if (!has_above && !has_below) in.mistake("", "must have below or above, or both");
  if (has_above) {
    limited.above =
        in.number({"above", "The value must be greater.", is_part ? "0.2" : "5 m"}, unit, range);
  }
  if (has_below) {
    limited.below =
        in.number({"below", "The value must be smaller.", is_part ? "0.2" : "10 m"}, unit, range);
  }
}

void await(Mapping& in, const std::string& state, const std::vector<hal::AgentId>& of,
           Scenario& scenario) {
  if (!of.empty()) scenario.awaited.push_back({in.place("state"), in.path() + ".state", of, state});
}

const Key kState{"state", "Their controllers are in this state, as they call it.", "FULFILLED"};

InState read_state(Mapping& in, Scenario& scenario) {
  InState it{read_subjects(in, scenario), in.text(kState)};
  await(in, it.state, it.who.agents, scenario);
  return it;
}

Area read_area(Mapping in) {
  const GivenKeys keys(in);
  Area area{Area::Circle{}};
  const bool is_circle = keys.has("radius");
  if (is_circle) {
    area.shape = Area::Circle{
        in.vec2({"centre", "Of a circle, world frame.", "[10 m, 5 m]"}, "m", kCoordinate),
        in.number({"radius", "Of a circle.", "3 m"}, "m", kApart)};
  }
  if (!is_circle || keys.is_survey()) {
    const Area::Box box{
        in.vec2(
            {"from", "Lower left corner of a box, world frame; a circle has `centre` and `radius`.",
             "[0 m, 0 m]"},
            "m", kCoordinate),
        in.vec2({"to", "Upper right corner of a box.", "[10 m, 5 m]"}, "m", kCoordinate)};
    if (box.high.x < box.low.x || box.high.y < box.low.y)
      in.mistake("to", "must not be left of, or below, `from`");
    area.shape = box;
  }
  in.finish();
  return area;
}

InArea read_in_area(Mapping& in, const Scenario& scenario) {
  return {read_subjects(in, scenario),
          read_area(in.mapping({"area", "They are inside: a circle or a box."}))};
}

BatteryLevel read_battery(Mapping& in, const Scenario& scenario) {
  BatteryLevel level;
  level.who = read_subjects(in, scenario);
  for (const hal::AgentId agent : level.who.agents) {
    if (!has_battery(declared(agent, scenario)))
      in.mistake("battery", fmt::format("{} has none", declared(agent, scenario).name));
  }
  Mapping limits =
      in.mapping({"battery",
                  "State of charge of their first battery, share of the capacity; seen once per "
                  "control cycle."});
  read_limits(limits, "1", {0, 1}, level);
  limits.finish();
  return level;
}

ApartBy read_distance(Mapping& in, const Scenario& scenario) {
  ApartBy apart;
  const auto names = in.texts({"distance", "True distance between two agents.", "[NAME0, NAME1]"});
  if (names.size() == 2) {
    apart.a = agent_named(in, "distance", names[0].text, scenario);
    apart.b = agent_named(in, "distance", names[1].text, scenario);
  } else {
    in.mistake("distance", fmt::format("must name two agents, not {}", names.size()));
  }
  read_limits(in, "m", kApart, apart);
  return apart;
}

CountOf read_count(Mapping& in, Scenario& scenario) {
  CountOf count;
  count.who.quantifier = Subjects::Quantifier::kAny;
  count.who.whose =
      in.text({"count",
               "Agents of which those in a `state` are counted, or the messages `received` by "
               "all of them together.",
               "'NAME*'"});
  if (!count.who.whose.empty())
    count.who.agents = agents_meant(in, "count", count.who.whose, scenario);
  const GivenKeys keys(in);
  if (keys.has("received")) {
    count.topic = in.text({"received", "With `count`: messages of this class.", "help"});
    if (!keys.is_survey()) in.refuse("state", "cannot stand beside received");
  }
  if (!keys.has("received") || keys.is_survey()) {
    count.state = in.text(kState);
    await(in, count.state, count.who.agents, scenario);
  }
  const bool has_least = keys.has("at_least"), has_most = keys.has("at_most");
  if (!has_least && !has_most) in.mistake("", "must have at_least or at_most, or both");
  if (has_least)
    count.at_least =
        in.integer({"at_least", "With `count`: so many, or more.", "3"}, 0, kMostCounted);
  if (has_most)
    count.at_most =
        in.integer({"at_most", "With `count`: so many, or fewer.", "3"}, 0, kMostCounted);
  return count;
}

struct CombinationKey {
  Combination::Kind kind;
  const char* name;
  const char* meaning;
};
constexpr std::array<CombinationKey, 2> kLists{
    {{Combination::Kind::kAll, "all_of", "Each of these conditions holds."},
     {Combination::Kind::kAny, "any_of", "At least one of these conditions holds."}}};

Combination read_list(Mapping& in, const CombinationKey& key, Scenario& scenario) {
  Combination combination{key.kind, {}};
  (void)in.mappings({key.name, key.meaning, "[{agent: NAME0, state: FULFILLED}, {time: 60 s}]"});
  // Conditions in conditions: their keys have been described.
  for (Mapping& part : in.items(key.name))
    combination.parts.push_back(read_condition(part, scenario));
  if (combination.parts.empty()) in.mistake(key.name, "must have at least one condition");
  return combination;
}

Combination read_not(Mapping& in, Scenario& scenario) {
  Combination combination{Combination::Kind::kNone, {}};
  (void)in.mapping({"not", "This condition does not hold.", "{agent: NAME0, state: FULFILLED}"});
  if (in.has_scalar("not")) return combination;  // which has been said
  combination.parts.push_back(read_condition(in.within("not"), scenario));
  return combination;
}

/// What a key says, and who reads it. The first of them that is there counts.
struct ConditionKind {
  const char* key;
  void (*read)(Mapping& in, Scenario& scenario, Condition& condition);
};
constexpr std::array<ConditionKind, 9> kKinds{
    {{"time",
      [](Mapping& in, Scenario&, Condition& condition) {
        condition.what =
            TimeReached{in.duration({"time", "From this time on.", "60 s"}, kConditionTime)};
      }},
     {"distance", [](Mapping& in, Scenario& scenario,
                     Condition& condition) { condition.what = read_distance(in, scenario); }},
     {"count", [](Mapping& in, Scenario& scenario,
                  Condition& condition) { condition.what = read_count(in, scenario); }},
     {"all_of", [](Mapping& in, Scenario& scenario,
                   Condition& condition) { condition.what = read_list(in, kLists[0], scenario); }},
     {"any_of", [](Mapping& in, Scenario& scenario,
                   Condition& condition) { condition.what = read_list(in, kLists[1], scenario); }},
     {"not", [](Mapping& in, Scenario& scenario,
                Condition& condition) { condition.what = read_not(in, scenario); }},
     {"area", [](Mapping& in, Scenario& scenario,
                 Condition& condition) { condition.what = read_in_area(in, scenario); }},
     {"battery", [](Mapping& in, Scenario& scenario,
                    Condition& condition) { condition.what = read_battery(in, scenario); }},
     {"state", [](Mapping& in, Scenario& scenario, Condition& condition) {
        condition.what = read_state(in, scenario);
      }}}};

}  // namespace

Condition read_condition(Mapping in, Scenario& scenario) {
  Condition condition;
  condition.place = in.place();
  const GivenKeys keys(in);
  bool is_said = false;
  for (const auto& [key, read] : kKinds) {
    if (!keys.has(key) || (is_said && !keys.is_survey())) continue;
    is_said = true;
    read(in, scenario, condition);
  }
  if (!is_said) {
    in.mistake("",
               "must say a condition: time, distance, count, all_of, any_of, not; or state, area "
               "or battery of an agent, of any or all of a pattern");
    for (const ConditionKind& kind : kKinds) in.has(kind.key);
    for (const char* key : {"agent", "any", "all", "below", "above"}) in.has(key);
  }
  condition.hold = in.duration({"for", "It must have held for so long without a break.", "5 s"},
                               kConditionTime, hal::Duration{});
  in.finish();
  return condition;
}

}  // namespace sim::scenario
