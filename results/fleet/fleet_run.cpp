#include "results/fleet/fleet_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "hal/types/pattern.h"
#include "results/fleet/played_topics.h"
#include "results/record/run_reader.h"

namespace results::fleet {
namespace {

using record::RunReader;
using record::Statement;

AgentNames agent_names(RunReader& reader) {
  AgentNames names;
  Statement agents = reader.query("SELECT agent, name FROM agents");
  while (agents.next()) names[agents.integer(0)] = agents.text(1);
  return names;
}

std::string name_at(const AgentNames& names, std::int64_t agent) {
  const auto found = names.find(agent);
  return found == names.end() ? "" : found->second;
}

/// By topic, writing and reading agent; several writers of an agent on one topic are one.
using PairKey = std::tuple<std::string, std::string, std::string>;
using Pairs = std::map<PairKey, SamplePair>;

/// What the players of `topics` were told, and how much they wrote: pairs of which perhaps nothing
/// was heard on the air.
void add_planned_pairs(const std::filesystem::path& folder, const AgentNames& names, double end_s,
                       Pairs& pairs) {
  const std::vector<PlayedTopics> players = read_players(folder, names, end_s);
  for (const PlayedTopics& writer : players) {
    for (const auto& [topic, plan] : writer.writes) {
      for (const PlayedTopics& reader : players) {
        if (reader.agent == writer.agent || !reader.reads.contains(topic)) continue;
        SamplePair& pair = pairs[{topic, writer.agent, reader.agent}];
        std::tie(pair.topic, pair.writer, pair.reader) =
            std::tie(topic, writer.agent, reader.agent);
        pair.plan = plan;
      }
    }
  }
}

/// The pairs that were announced on the air, without samples.
Pairs announced_pairs(RunReader& reader, const AgentNames& names) {
  Pairs pairs;
  Statement found = reader.query(
      "SELECT w.topic, w.agent, r.agent FROM dds_endpoints w JOIN dds_endpoints r "
      "ON r.topic = w.topic AND r.type = w.type AND r.agent <> w.agent "
      "WHERE w.kind = 'writer' AND r.kind = 'reader'");
  while (found.next()) {
    SamplePair pair{found.text(0), name_at(names, found.integer(1)),
                    name_at(names, found.integer(2))};
    PairKey key{pair.topic, pair.writer, pair.reader};
    pairs.emplace(std::move(key), std::move(pair));
  }
  return pairs;
}

SampleFate fate_in(const Statement& row, const AgentNames& names) {
  SampleFate fate{.entered = hal::time_from_ns(row.integer(3))};
  if (!row.is_null(4)) fate.left = hal::time_from_ns(row.integer(4));
  fate.is_repaired = row.integer(5) != 0;
  fate.verdict = row.text(6);
  if (!row.is_null(7)) fate.lost_at = name_at(names, row.integer(7));
  return fate;
}

Pairs pairs_of(RunReader& reader, const AgentNames& names) {
  Pairs pairs = announced_pairs(reader, names);
  Statement samples = reader.query(
      "SELECT e.topic, e.agent, s.receiver, s.entered_ns, s.left_ns, s.repaired, s.verdict, "
      "s.lost_at FROM samples s JOIN dds_endpoints e ON e.guid = s.writer "
      "WHERE e.agent IS NOT NULL ORDER BY s.entered_ns");
  while (samples.next()) {
    const PairKey key{samples.text(0), name_at(names, samples.integer(1)),
                      name_at(names, samples.integer(2))};
    SamplePair& pair = pairs[key];
    std::tie(pair.topic, pair.writer, pair.reader) = key;
    pair.samples.push_back(fate_in(samples, names));
  }
  return pairs;
}

/// What a transmission that is not of a topic is for.
std::string use_of(const std::string& purpose, const std::string& kind) {
  if (purpose == "SPDP" || purpose == "SEDP") return "discovery";
  if (purpose == "liveliness" || purpose == "builtin" || purpose == "RTPS") return "DDS, other";
  if (purpose == "802.11") return kind == "ack" || kind == "block ack" ? "802.11 acks" : "802.11";
  return purpose;
}

void read_air(RunReader& reader, const std::vector<std::string>& agents, FleetRun& run) {
  Statement air = reader.query("SELECT purpose, kind, topic, airtime_ns FROM air_accounts");
  while (air.next()) {
    const bool is_sample = air.text(1) == "DATA" || air.text(1) == "DATA_FRAG";
    std::string what = use_of(air.text(0), air.text(1));
    if (air.text(0) == "user") {
      what = air.is_null(2) ? "topics not announced" : group_of(air.text(2), agents);
      if (!is_sample) what = "DDS heartbeats and acks";
    }
    run.air[what] += 1e-9 * static_cast<double>(air.integer(3)) / run.simulated_s;
  }
}

/// The agent with the greatest sum of a value over the samples in the window, and that sum.
std::pair<std::string, double> greatest(Statement& sums, const AgentNames& names) {
  std::pair<std::string, double> most{"", 0};
  while (sums.next()) {
    if (sums.real(1) > most.second) most = {name_at(names, sums.integer(0)), sums.real(1)};
  }
  return most;
}

/// From the observables that plan_of() asks for. A share stands at the end of its second.
void read_radios(RunReader& reader, const AgentNames& names, const Window& window, FleetRun& run) {
  const auto sums_of = [&](std::string_view value, std::string_view domain) {
    return fmt::format(
        "SELECT o.agent, SUM({}) FROM observables o JOIN observable_samples s "
        "ON s.observable = o.observable WHERE o.name {} AND s.at_ns > {} GROUP BY o.agent",
        value, domain, hal::to_ns(window.from));
  };
  Statement shares =
      reader.query(sums_of("s.value", "IN ('radio.transmit_share', 'radio.receive_share')"));
  const auto [busiest, busy] = greatest(shares, names);
  Statement seconds = reader.query(sums_of("1.0", "= 'radio.transmit_share'"));
  if (const double all = greatest(seconds, names).second; all > 0) {
    run.busy = busy / all;
    run.busiest = busiest;
  }
  Statement filled = reader.query(sums_of("s.value > 0", "= 'radio.queue'"));
  const auto [most_backlogged, backlogged] = greatest(filled, names);
  Statement samples = reader.query(sums_of("1.0", "= 'radio.queue'"));
  if (const double all = greatest(samples, names).second; all > 0) {
    run.backlogged = backlogged / all;
    run.most_backlogged = most_backlogged;
  }
}

/// Whether stations associate with access points.
bool has_access_points(RunReader& reader) {
  Statement found = reader.query(
      "SELECT key FROM settings WHERE key LIKE '%bss.access_point%' AND value <> '[]'");
  return found.next();
}

/// Counts handovers, and agents of the pairs that never had an access point.
void read_associations(RunReader& reader, const AgentNames& names, const Pairs& pairs,
                       FleetRun& run) {
  std::set<std::string> without;
  for (const auto& [key, pair] : pairs) without.insert({pair.writer, pair.reader});
  std::map<std::int64_t, std::int64_t> last;
  Statement found =
      reader.query("SELECT station, access_point FROM associations ORDER BY at_ns, rowid");
  while (found.next()) {
    if (found.is_null(1)) continue;
    const std::int64_t point = found.integer(1);
    without.erase(name_at(names, found.integer(0)));
    without.erase(name_at(names, point));
    const auto [before, is_first] = last.try_emplace(found.integer(0), point);
    if (!is_first && before->second != point) ++run.handovers;
    before->second = point;
  }
  if (has_access_points(reader)) run.unassociated = without.size();
}

}  // namespace

std::string group_of(const std::string& topic, const std::vector<std::string>& agents) {
  std::string group;
  for (std::size_t at = 0; at <= topic.size();) {
    const std::size_t end = std::min(topic.find('/', at), topic.size());
    const std::string part = topic.substr(at, end - at);
    const bool is_agent = std::ranges::find(agents, part) != agents.end();
    group.append(at == 0 ? "" : "/").append(is_agent ? "*" : part);
    at = end + 1;
  }
  return group;
}

FleetRun read_fleet_run(const std::filesystem::path& folder, const FleetFile& fleet) {
  RunReader reader(folder);
  FleetRun run;
  run.simulated_s = reader.real("simulated_s").value_or(0);
  run.wall_s = reader.real("wall_s").value_or(0);
  if (run.simulated_s <= hal::to_seconds(fleet.warm_up)) {
    throw std::runtime_error(fmt::format("{}: the run ended at {} s, before warm_up, {} s",
                                         folder.string(), run.simulated_s,
                                         hal::to_seconds(fleet.warm_up)));
  }
  const AgentNames names = agent_names(reader);
  std::vector<std::string> agents;
  for (const auto& [agent, name] : names) agents.push_back(name);
  Pairs pairs = pairs_of(reader, names);
  add_planned_pairs(folder, names, run.simulated_s, pairs);
  const Window window{hal::Time{fleet.warm_up}, hal::Time{hal::from_seconds(run.simulated_s)}};
  std::map<std::string, std::vector<const SamplePair*>> groups;
  for (const auto& [key, pair] : pairs) groups[group_of(pair.topic, agents)].push_back(&pair);
  for (const auto& [group, some] : groups) run.topics[group] = measure(some, window);
  for (const Need& need : fleet.needs) {
    std::vector<const SamplePair*> some;
    for (const auto& [key, pair] : pairs) {
      if (hal::matches(need.topic, pair.topic) && hal::matches(need.readers, pair.reader)) {
        some.push_back(&pair);
      }
    }
    run.needs.push_back(measure(some, window));
  }
  read_air(reader, agents, run);
  read_radios(reader, names, window, run);
  read_associations(reader, names, pairs, run);
  return run;
}

}  // namespace results::fleet
