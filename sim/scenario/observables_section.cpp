#include "sim/scenario/observables_section.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "hal/config/suggest.h"
#include "sim/scenario/fields.h"

namespace sim::scenario {
namespace {

using record::Keeps;
using record::ObservablePattern;
using record::ObservableRequest;

constexpr std::array kKeeps = {
    Option<Keeps>{"samples", Keeps::kSamples}, Option<Keeps>{"histogram", Keeps::kHistogram},
    Option<Keeps>{"quantiles", Keeps::kQuantiles}, Option<Keeps>{"counter", Keeps::kCounter}};
/// `on` has one value: what is looked at when something happens.
constexpr std::array kOn = {Option<bool>{"change", true}};
constexpr Range kEvery{1e-3, hal::config::kLongestDuration};  // s
constexpr Range kAny{-1e150, 1e150};

/// What observes a value of an agent in a certain way, so that it is asked for once only.
using AskedFor = std::map<std::string, std::string>;

void read_when(Mapping& in, ObservableRequest& request) {
  if (in.has("on")) {
    (void)in.choice(
        {"on",
         "Look at it when it changes: what only happens, as a delay or what a controller "
         "records, each time; all else at control instants, if it is not as before.",
         "change"},
        kOn);
    request.every.reset();
    in.refuse("every", "cannot stand beside on");
    return;
  }
  request.every = in.duration({"every",
                               "Look at it at time 0 and then after each period, when all that "
                               "happens at that instant has happened.",
                               "1 s"},
                              kEvery, *request.every);
}

void read_histogram(Mapping& in, ObservableRequest& request) {
  if (request.keeps != Keeps::kHistogram) {
    for (const char* key : {"bins", "range"}) in.refuse(key, "needs `as: histogram`");
    return;
  }
  const bool has_range = in.has("range");
  request.bins = static_cast<std::size_t>(
      in.integer({"bins", "Of a histogram; without `range` rounded up to an even number.", "50"}, 2,
                 10'000, static_cast<std::int64_t>(request.bins)));
  const hal::Vec2 range =
      in.vec2({"range",
               "Of a histogram, in the unit of the value: from, and below. Values outside are "
               "counted as such. Without it the range is found, and grows.",
               "[0, 10]", "found"},
              "1", kAny, hal::Vec2{});
  if (!has_range) return;
  request.range = {range.x, range.y};
  if (!(range.x < range.y)) in.mistake("range", "must begin below its end");
}

/// Values of a domain that some agent of the pattern has; empty: no agent matches.
std::set<std::string> values_of(const ObservablePattern& pattern, const Scenario& scenario,
                                std::vector<std::string>& matching) {
  std::set<std::string> values;
  for (const agents::AgentConfig& agent : scenario.simulation.agents) {
    if (!pattern.has_agent(agent.name)) continue;
    for (const record::Observable& one : record::observables_of(agent, scenario.simulation)) {
      if (one.domain != pattern.domain) continue;
      values.insert(one.value);
      if (pattern.has_value(one.value)) matching.push_back(agent.name + "." + one.value);
    }
  }
  return values;
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

/// What is wrong with the name; empty: nothing.
std::string mistake_in(const ObservablePattern& pattern, const std::set<std::string>& values,
                       const std::vector<std::string>& matching, const Scenario& scenario) {
  using hal::config::suggestion;
  const std::vector<std::string> domains = record::observable_domains();
  if (std::ranges::find(domains, pattern.domain) == domains.end()) {
    return fmt::format("'{}' is none of {}{}", pattern.domain, fmt::join(domains, ", "),
                       suggestion(pattern.domain, domains));
  }
  if (!has_agent_like(pattern, scenario)) {
    return fmt::format("'{}' matches no agent{}", pattern.agents,
                       suggestion(pattern.agents, agent_names(scenario)));
  }
  if (pattern.domain == record::kControllersDomain || !matching.empty()) return {};
  return fmt::format("{} have no '{}' in {}{}; `baraka describe observables` lists all",
                     pattern.agents, pattern.value, pattern.domain,
                     suggestion(pattern.value, {values.begin(), values.end()}));
}

void judge_name(Mapping& in, const ObservableRequest& request, const Scenario& scenario,
                AskedFor& taken) {
  const auto pattern = ObservablePattern::of(request.name);
  if (!pattern) {
    if (request.name.empty()) return;  // missing, which was said
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
  if (pattern->domain == record::kControllersDomain) matching = {request.name};
  for (const std::string& one : matching) {
    const std::string way = fmt::format("{}.{} as {}", pattern->domain, one, name(request.keeps));
    const auto [other, is_new] = taken.emplace(way, in.place("name"));
    if (is_new) continue;
    in.mistake("name", fmt::format("{} is asked for at {} already", way, other->second));
    return;
  }
}

}  // namespace

void read_observables(Mapping& record, Scenario& scenario) {
  AskedFor taken;
  for (Mapping& in : record.mappings(
           {"observables",
            "Values that the results follow through the run, beyond what they have in any case: "
            "`baraka describe observables` lists them.",
            "[{name: agents.*.x, every: 1 s}]"})) {
    ObservableRequest request;
    request.name = in.text({"name",
                            "Which: DOMAIN.AGENT.VALUE, in agent and value with `*` for any "
                            "letters and `?` for one.",
                            "agents.r*.speed"});
    read_when(in, request);
    request.keeps =
        in.choice({"as",
                   "What is kept besides count, mean, deviation, least, greatest and last value: "
                   "each value; a histogram; quantiles, exact up to 10000 values and then to a "
                   "thousandth of the rank; or nothing.",
                   "samples"},
                  kKeeps, request.keeps);
    read_histogram(in, request);
    if (request.keeps == Keeps::kSamples) {
      request.most = static_cast<std::uint64_t>(
          in.integer({"most", "Samples kept of a value of an agent: the first so many.", "100000"},
                     1, 1'000'000'000, static_cast<std::int64_t>(request.most)));
    } else {
      in.refuse("most", "needs `as: samples`");
    }
    judge_name(in, request, scenario, taken);
    scenario.record.observable_places.push_back(in.place("name"));
    scenario.record.observables.push_back(std::move(request));
    in.finish();
  }
}

void write_observables(Writer& out, const Scenario& scenario) {
  if (scenario.record.observables.empty()) return;
  out.open_list("observables");
  for (const ObservableRequest& request : scenario.record.observables) {
    out.open_item();
    out.text("name", request.name);
    if (request.every) {
      out.duration("every", *request.every);
    } else {
      out.text("on", "change");
    }
    out.text("as", name(request.keeps));
    if (request.keeps == Keeps::kHistogram) {
      out.integer("bins", static_cast<std::int64_t>(request.bins));
      if (request.range) out.numbers("range", {request.range->first, request.range->second}, "1");
    }
    if (request.keeps == Keeps::kSamples) {
      out.integer("most", static_cast<std::int64_t>(request.most));
    }
    out.close();
  }
  out.close();
}

}  // namespace sim::scenario
