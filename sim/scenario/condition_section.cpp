#include "sim/scenario/condition_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "sim/scenario/agent_names.h"

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

constexpr Range kConditionTime{0, hal::files::config::kLongestDuration};  // s
constexpr Range kApart{0, 1e9};                                           // m
constexpr std::int64_t kMostCounted = 1'000'000'000'000;
/// The agents that names refer to, and the list of states in use.
struct Context {
  const Scenario& scenario;
  decltype(Scenario::awaited)& awaited;
};

void keys_of(Fields& io, Condition& c, const Context& context);

Condition read(Mapping in, const Context& context) {
  Condition condition;
  FieldReader io(in);
  keys_of(io, condition, context);
  in.finish();
  return condition;
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr auto kNoLimit = std::numeric_limits<std::int64_t>::max();

/// The agents of a condition, as the value of a key: a name or a pattern.
void subject_key(Fields& io, const Key& key, Subjects::Quantifier quantifier, Subjects& who,
                 const Context& context) {
  io.needed_text(key, who.whose);
  if (io.reading() == nullptr) return;
  who.quantifier = quantifier;
  if (!who.whose.empty())
    who.agents = agents_meant(*io.reading(), key.name, who.whose, context.scenario);
}

void keys_of(Fields& io, Subjects& who, const Context& context) {
  using Quantifier = Subjects::Quantifier;
  const auto saying = [&](const Key& key, Quantifier quantifier) {
    return Fields::Saying{
        key.name, who.quantifier == quantifier,
        [&, key, quantifier](Fields& one) { subject_key(one, key, quantifier, who, context); }};
  };
  const Key agent{"agent", "Agent that is examined; or use `any` or `all` with a pattern.",
                  "NAME0"};
  const bool is_said = io.first_of(
      {saying({"any", "At least one of the agents whose names match.", "'NAME*'"},
              Quantifier::kAny),
       saying({"all", "Every one of the agents whose names match.", "'NAME*'"}, Quantifier::kAll),
       saying(agent, Quantifier::kOne)});
  if (!is_said) subject_key(io, agent, Quantifier::kOne, who, context);
}

/// `above` and `below`, at least one of them.
template <class Limited>
void limit_keys(Fields& io, std::string_view unit, Range range, Limited& limited) {
  const bool is_part = unit == "1";
  std::optional<double> above, below;
  if (limited.above > -kInfinity) above = limited.above;
  if (limited.below < kInfinity) below = limited.below;
  io.given({"above", "The value must be greater than this.", is_part ? "0.2" : "5 m",
            "none if `below` is given"},
           unit, range, above);
  io.given({"below", "The value must be less than this.", is_part ? "0.2" : "10 m",
            "none if `above` is given"},
           unit, range, below);
  if (!above && !below) io.mistake("", "must have below or above, or both");
  limited.above = above.value_or(-kInfinity);
  limited.below = below.value_or(kInfinity);
}

/// Notes that these agents are asked for a state, for a check against the states that controllers
/// declare.
void state_key(Fields& io, std::string& state, const std::vector<hal::AgentId>& of,
               const Context& context) {
  io.needed_text({"state",
                  "State that the controllers of these agents must be in, by the name that the "
                  "controller gives it.",
                  "FULFILLED"},
                 state);
  if (const Mapping* in = io.reading(); in != nullptr && !of.empty())
    context.awaited.push_back({in->place("state"), in->path() + ".state", of, state});
}

void keys_of(Fields& io, Area& area) {
  const auto box = [&](Fields& one) {
    auto& [low, high] = as<Area::Box>(area.shape);
    one.needed({"from",
                "Corner of a box with the smallest x and y, world frame; a circle has `centre` and "
                "`radius` instead.",
                "[0 m, 0 m]"},
               "m", kCoordinate, low);
    one.needed({"to", "Corner of the box with the largest x and y, world frame.", "[10 m, 5 m]"},
               "m", kCoordinate, high);
    if (high.x < low.x || high.y < low.y)
      one.mistake("to", "must not be left of, or below, `from`");
  };
  const auto circle = [&](Fields& one) {
    auto& [centre, radius] = as<Area::Circle>(area.shape);
    one.needed({"centre", "Centre of a circle, world frame.", "[10 m, 5 m]"}, "m", kCoordinate,
               centre);
    one.needed({"radius", "Radius of the circle.", "3 m"}, "m", kApart, radius);
  };
  const bool is_box = std::holds_alternative<Area::Box>(area.shape);
  if (!io.first_of({{"radius", !is_box, circle}, {"from", is_box, box}})) box(io);
}

void keys_of(Fields& io, InArea& c, const Context& context) {
  keys_of(io, c.who, context);
  io.inside({"area", "Area that these agents must be in: a circle or a box."},
            [&](Fields& area) { keys_of(area, c.area); });
}

void keys_of(Fields& io, InState& c, const Context& context) {
  keys_of(io, c.who, context);
  state_key(io, c.state, c.who.agents, context);
}

void keys_of(Fields& io, TimeReached& c, const Context& /*context*/) {
  io.needed({"time", "True from this simulated time on.", "60 s"}, kConditionTime, c.at);
}

void keys_of(Fields& io, BatteryLevel& c, const Context& context) {
  keys_of(io, c.who, context);
  for (const hal::AgentId agent : c.who.agents) {
    if (!has_battery(declared(agent, context.scenario)))
      io.mistake("battery", fmt::format("{} has none", declared(agent, context.scenario).name));
  }
  io.inside({"battery",
             "State of charge of their first battery, as a share of its capacity; examined once "
             "per control cycle."},
            [&](Fields& limits) {
              limit_keys(limits, "1", {0, 1}, c);
            });
}

void keys_of(Fields& io, ApartBy& c, const Context& context) {
  std::vector<std::string> names;
  if (io.is_writing())
    names = {declared(c.a, context.scenario).name, declared(c.b, context.scenario).name};
  io.texts({"distance", "True distance between the origins of two agents.", "[NAME0, NAME1]"},
           names);
  if (Mapping* const in = io.reading(); in != nullptr && names.size() == 2) {
    c.a = agent_named(*in, "distance", names[0], context.scenario);
    c.b = agent_named(*in, "distance", names[1], context.scenario);
  } else {
    io.mistake("distance", fmt::format("must name two agents, not {}", names.size()));
  }
  limit_keys(io, "m", kApart, c);
}

/// At least one of the limits must be given.
void count_keys(Fields& io, CountOf& c) {
  std::optional<std::int64_t> least, most;
  if (c.at_least > 0) least = c.at_least;
  if (c.at_most < kNoLimit || !least) most = std::min(c.at_most, kMostCounted);
  if (!io.is_writing()) most.reset();
  io.given_count({"at_least", "With `count`: there must be at least this many.", "3",
                  "none if `at_most` is given"},
                 0, kMostCounted, least);
  io.given_count({"at_most", "With `count`: there must be at most this many.", "3",
                  "none if `at_least` is given"},
                 0, kMostCounted, most);
  if (!least && !most) io.mistake("", "must have at_least or at_most, or both");
  if (io.reading() == nullptr) return;
  c.at_least = least.value_or(0);
  c.at_most = most.value_or(kNoLimit);
}

void keys_of(Fields& io, CountOf& c, const Context& context) {
  subject_key(io,
              {"count",
               "Counts the matching agents that are in `state`, or the messages that all of them "
               "together have `received`.",
               "'NAME*'"},
              Subjects::Quantifier::kAny, c.who, context);
  const auto received = [&](Fields& one) {
    one.needed_text(
        {"received", "With `count`: counts received messages of this class (topic).", "help"},
        c.topic);
    one.unused("state", "cannot be combined with received");
  };
  const auto state = [&](Fields& one) { state_key(one, c.state, c.who.agents, context); };
  if (!io.first_of({{"received", c.state.empty(), received}, {"state", !c.state.empty(), state}}))
    state(io);
  count_keys(io, c);
}

void read_list(Mapping& in, const Key& key, std::vector<Condition>& parts, const Context& context) {
  (void)in.mappings(key);
  for (Mapping& part : in.items(key.name)) parts.push_back(read(part, context));
  if (parts.empty()) in.mistake(key.name, "must have at least one condition");
}

void read_not(Mapping& in, const Key& key, std::vector<Condition>& parts, const Context& context) {
  (void)in.mapping(key);
  if (in.has_scalar(key.name)) return;  // reported already
  parts.push_back(read(in.within(key.name), context));
}

void write_list(Writer& out, const Key& key, std::vector<Condition>& parts,
                const Context& context) {
  FieldWriter writer(out);
  out.open_list(key.name);
  for (Condition& part : parts) {
    out.open_item();
    keys_of(writer, part, context);
    out.close();
  }
  out.close();
}

/// The conditions of a combination, whose keys have been described.
void part_keys(Fields& io, const Key& key, Combination::Kind kind, Combination& c,
               const Context& context) {
  const bool is_not = kind == Combination::Kind::kNone;
  if (!io.is_writing()) c.kind = kind;
  io.own(
      key, {.kind = is_not ? Form::Kind::kMapping : Form::Kind::kMappings},
      [&](Mapping& in) { (is_not ? read_not : read_list)(in, key, c.parts, context); },
      [&](Writer& out) {
        if (!is_not) return write_list(out, key, c.parts, context);
        FieldWriter writer(out);
        out.open(key.name);
        keys_of(writer, c.parts.front(), context);
        out.close();
      });
}

template <class Kind>
Fields::Saying saying(const char* key, Condition& condition, const Context& context) {
  return {key, std::holds_alternative<Kind>(condition.what),
          [&](Fields& io) { keys_of(io, as<Kind>(condition.what), context); }};
}

Fields::Saying saying(const Key& key, Combination::Kind kind, Condition& condition,
                      const Context& context) {
  const auto* const said = std::get_if<Combination>(&condition.what);
  return {key.name, said != nullptr && said->kind == kind, [&, key, kind](Fields& io) {
            part_keys(io, key, kind, as<Combination>(condition.what), context);
          }};
}

constexpr std::string_view kTwoConditions = "[{agent: NAME0, state: FULFILLED}, {time: 60 s}]";

void keys_of(Fields& io, Condition& c, const Context& context) {
  using Kind = Combination::Kind;
  const std::vector<Fields::Saying> sayings{
      saying<TimeReached>("time", c, context),
      saying<ApartBy>("distance", c, context),
      saying<CountOf>("count", c, context),
      saying({"all_of", "All of these conditions hold.", kTwoConditions}, Kind::kAll, c, context),
      saying({"any_of", "At least one of these conditions holds.", kTwoConditions}, Kind::kAny, c,
             context),
      saying({"not", "This condition does not hold.", "{agent: NAME0, state: FULFILLED}"},
             Kind::kNone, c, context),
      saying<InArea>("area", c, context),
      saying<BatteryLevel>("battery", c, context),
      saying<InState>("state", c, context)};
  if (Mapping* const in = io.reading()) c.place = in->place();
  if (!io.first_of(sayings)) {
    io.mistake("",
               "must have a condition: time, distance, count, all_of, any_of, not; or state, area "
               "or battery of an agent, of any or all of a pattern");
    for (const Fields::Saying& one : sayings) io.reading()->has(one.key);
    for (const char* key : {"agent", "any", "all", "below", "above"}) io.reading()->has(key);
  }
  io.only(!io.is_writing() || c.hold > hal::Duration{}, {}, "", [&](Fields& held) {
    held.duration(
        {"for", "The condition must have held for this long without interruption.", "5 s"},
        kConditionTime, c.hold);
  });
}

}  // namespace

void keys_of(Fields& io, Condition& condition, Scenario& scenario) {
  keys_of(io, condition, Context{scenario, scenario.awaited});
}

Condition read_condition(Mapping in, Scenario& scenario) {
  return read(std::move(in), {scenario, scenario.awaited});
}

void write_condition(Writer& out, Condition condition, const Scenario& scenario) {
  FieldWriter io(out);
  decltype(Scenario::awaited) none;
  keys_of(io, condition, {scenario, none});
}

}  // namespace sim::scenario
