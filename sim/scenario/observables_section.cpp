#include "sim/scenario/observables_section.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "hal/files/config/suggest.h"
#include "hal/types/pattern.h"
#include "sim/scenario/fields.h"

namespace sim::scenario {
namespace {

/// `on` has one value: sampled at each change.
constexpr std::array kOn = {Option<bool>{"change", true}};
constexpr Range kEvery{1e-3, hal::files::config::kLongestDuration};  // s
constexpr Range kAny{-1e150, 1e150};

/// Values already requested, by agent, value and kind of observation; a second request is a
/// mistake.
using AskedFor = std::map<std::string, std::string>;

void when_keys(Fields& io, ObservableRequest& c) {
  std::optional<bool> on_change;
  if (!c.every) on_change = true;
  io.given_choice(
      {"on",
       "change: record each change. Values of single occurrences, such as a delay or a value that "
       "a controller records, are recorded each time; all others are compared at control instants.",
       "change"},
      kOn, on_change);
  hal::Duration every = c.every.value_or(hal::Duration{});
  io.only(!on_change, {"on", {"absent"}}, "cannot be combined with on", [&](Fields& at_times) {
    at_times.duration({"every",
                       "Sampling period: the value is read at time 0 and after each period, when "
                       "all events of that instant have been processed.",
                       "1 s"},
                      kEvery, every);
  });
  c.every = on_change ? std::nullopt : std::optional(every);
}

void histogram_keys(Fields& io, ObservableRequest& c) {
  io.count(
      {"bins", "Number of bins of the histogram; without `range`, rounded up to an even number.",
       "50"},
      2, 10'000, c.bins);
  std::optional<hal::Vec2> range;
  if (c.range) range = {c.range->first, c.range->second};
  io.given({"range",
            "Range of the histogram in the unit of the value: lower bound included, upper bound "
            "excluded. Values outside are counted separately. Without it the range adapts to the "
            "values.",
            "[0, 10]", "found"},
           "1", kAny, range);
  if (range) c.range = {range->x, range->y};
  if (range && !(range->x < range->y)) io.mistake("range", "must begin below its end");
}

void observable_keys(Fields& io, ObservableRequest& c) {
  io.needed_text(
      {"name",
       "DOMAIN.AGENT.VALUE; AGENT and VALUE may contain `*` for any characters and `?` for one.",
       "agents.r*.speed"},
      c.name);
  when_keys(io, c);
  io.choice({"as",
             "What is stored besides count, mean, standard deviation, least, greatest and last "
             "value. samples: each value; histogram; quantiles: exact up to 10000 values, beyond "
             "that to a thousandth of the rank; counter: nothing more.",
             "samples"},
            kKeeps, c.keeps);
  io.only(c.keeps == Keeps::kHistogram, {"as", {"histogram"}}, "needs `as: histogram`",
          [&](Fields& histogram) { histogram_keys(histogram, c); });
  io.only(c.keeps == Keeps::kSamples, {"as", {"samples"}}, "needs `as: samples`",
          [&](Fields& samples) {
            samples.count(
                {"most",
                 "Largest number of samples stored per value and agent; later ones are not stored.",
                 "100000"},
                1, 1'000'000'000, c.most);
          });
}

/// The values in a domain that agents of the pattern have; `matching` receives the agents.
std::set<std::string> values_of(const ObservablePattern& pattern, const Scenario& scenario,
                                std::vector<std::string>& matching) {
  std::set<std::string> values;
  for (const agents::AgentConfig& agent : scenario.simulation.agents) {
    if (!pattern.has_agent(agent.name)) continue;
    for (const Observable& one : observables_of(agent, scenario.simulation)) {
      if (one.domain != pattern.domain) continue;
      values.insert(one.value);
      if (pattern.has_value(one.value)) matching.push_back(agent.name + "." + one.value);
    }
  }
  return values;
}

/// Whether values of a domain become known during the run only.
bool is_known_later(const std::string& domain) {
  return domain == kControllersDomain || domain == kDdsDomain;
}

bool has_agent_like(const ObservablePattern& pattern, const Scenario& scenario) {
  return std::ranges::any_of(scenario.simulation.agents, [&](const agents::AgentConfig& agent) {
    return pattern.has_agent(agent.name);
  });
}

std::vector<std::string> agent_names(const Scenario& scenario) {
  std::vector<std::string> names;
  for (const agents::AgentConfig& agent : scenario.simulation.agents) names.push_back(agent.name);
  return names;
}

std::set<std::string> names_of_dds_values() {
  std::set<std::string> names;
  for (const DdsValueKind& kind : dds_value_kinds()) names.emplace(kind.name);
  return names;
}

/// What is wrong with the name of a value of DDS topics, which are not known yet; empty if nothing
/// is.
std::string mistake_in_dds(const ObservablePattern& pattern, const Scenario& scenario) {
  bool has_network = false;
  for (const DdsValueKind& kind : dds_value_kinds()) {
    for (const agents::AgentConfig& agent : scenario.simulation.agents) {
      if (!pattern.has_agent(agent.name) || !has_dds(agent, scenario.simulation, kind.side))
        continue;
      has_network = true;
      if (hal::overlap(pattern.value, dds_value_name("*?", kind))) return {};
    }
  }
  if (!has_network) {
    return fmt::format("{} have no programs with a `network`, and so no DDS topics",
                       pattern.agents);
  }
  const std::set<std::string> names = names_of_dds_values();
  const std::string last = pattern.value.substr(pattern.value.rfind('.') + 1);
  return fmt::format("'{}' must be TOPIC.VALUE, with one of the values {} that {} have{}",
                     pattern.value, fmt::join(names, ", "), pattern.agents,
                     hal::files::config::suggestion(last, {names.begin(), names.end()}));
}

/// What is wrong with the name; empty if nothing is.
std::string mistake_in(const ObservablePattern& pattern, const std::set<std::string>& values,
                       const std::vector<std::string>& matching, const Scenario& scenario) {
  using hal::files::config::suggestion;
  const std::vector<std::string> domains = observable_domains();
  if (std::ranges::find(domains, pattern.domain) == domains.end()) {
    return fmt::format("'{}' is none of {}{}", pattern.domain, fmt::join(domains, ", "),
                       suggestion(pattern.domain, domains));
  }
  if (!has_agent_like(pattern, scenario)) {
    return fmt::format("'{}' matches no agent{}", pattern.agents,
                       suggestion(pattern.agents, agent_names(scenario)));
  }
  if (pattern.domain == kDdsDomain) return mistake_in_dds(pattern, scenario);
  if (pattern.domain == kControllersDomain || !matching.empty()) return {};
  return fmt::format("{} have no '{}' in {}{}; `baraka describe observables` lists all",
                     pattern.agents, pattern.value, pattern.domain,
                     suggestion(pattern.value, {values.begin(), values.end()}));
}

void judge_name(Mapping& in, const ObservableRequest& request, const Scenario& scenario,
                AskedFor& taken) {
  const auto pattern = ObservablePattern::of(request.name);
  if (!pattern) {
    if (request.name.empty()) return;  // a missing name was reported already
    in.mistake("name", fmt::format("'{}' must have three parts, DOMAIN.AGENT.VALUE, e.g. "
                                   "agents.*.x; `baraka describe observables` lists them",
                                   request.name));
    return;
  }
  std::vector<std::string> matching;
  const std::set<std::string> values = values_of(*pattern, scenario, matching);
  if (std::string what = mistake_in(*pattern, values, matching, scenario); !what.empty()) {
    in.mistake("name", std::move(what));
  }
  if (is_known_later(pattern->domain)) matching = {request.name};
  for (const std::string& one : matching) {
    const std::string way = fmt::format("{}.{} as {}", pattern->domain, one, name(request.keeps));
    const auto [other, is_new] = taken.emplace(way, in.place("name"));
    if (is_new) continue;
    in.mistake("name", fmt::format("{} is asked for at {} already", way, other->second));
    return;
  }
}

}  // namespace

void observables_keys(Fields& io, Scenario& scenario) {
  AskedFor taken;
  io.list_if_any<ObservableRequest>(
      {"observables",
       "Further values to record over the run, besides those that every result has; `baraka "
       "describe observables` lists them.",
       "[{name: agents.*.x, every: 1 s}]"},
      scenario.record.observables, [&](Fields& one, ObservableRequest& request) {
        observable_keys(one, request);
        if (one.reading() == nullptr) return;
        judge_name(*one.reading(), request, scenario, taken);
        scenario.record.observable_places.push_back(one.reading()->place("name"));
      });
}

}  // namespace sim::scenario
