#include "results/report/run_result.h"

#include <algorithm>
#include <cstdlib>

#include "hal/types/agent_id.h"
#include "results/record/run_reader.h"
#include "results/report/run_result_air.h"

namespace results::report {
namespace {

namespace fs = std::filesystem;
using record::RunReader;
using record::Statement;

void read_values(RunReader& reader, RunResult& run) {
  Statement query = reader.query("SELECT key, value FROM run");
  while (query.next()) run.values[query.text(0)] = query.text(1);
  Statement settings = reader.query("SELECT key, value FROM settings");
  while (settings.next()) run.settings[settings.text(0)] = settings.text(1);
}

void read_agents(RunReader& reader, RunResult& run) {
  Statement query = reader.query("SELECT agent, name, kind, x_m, y_m FROM agents ORDER BY agent");
  while (query.next()) {
    run.agents.push_back({.agent = static_cast<int>(query.integer(0)),
                          .name = query.text(1),
                          .is_robot = query.text(2) == "robot",
                          .x = query.real(3),
                          .y = query.real(4)});
  }
}

std::optional<std::uint64_t> count(const Statement& query, int column) {
  if (query.is_null(column)) return std::nullopt;
  return static_cast<std::uint64_t>(query.integer(column));
}

void read_bodies(RunReader& reader, RunResult& run) {
  Statement query = reader.query(
      "SELECT agent, path_m, clearance_m, x_m, y_m, wall_steps, object_steps"
      " FROM bodies");
  while (query.next()) {
    RunResult::Body& body = run.bodies[static_cast<int>(query.integer(0))];
    body.path = query.real(1);
    if (!query.is_null(2)) body.clearance = query.real(2);
    body.x = query.real(3);
    body.y = query.real(4);
    body.wall_steps = count(query, 5);
    body.object_steps = count(query, 6);
  }
}

void read_walls(RunReader& reader, RunResult& run) {
  Statement query =
      reader.query("SELECT name, x_m, y_m, yaw_rad, size_x_m, size_y_m FROM walls ORDER BY rowid");
  while (query.next()) {
    run.walls.push_back({.name = query.text(0),
                         .x = query.real(1),
                         .y = query.real(2),
                         .yaw = query.real(3),
                         .length_x = query.real(4),
                         .length_y = query.real(5)});
  }
}

void read_tracks(RunReader& reader, RunResult& run) {
  Statement query = reader.query(
      "SELECT p.agent, p.at_ns, p.x_m, p.y_m FROM poses p JOIN agents a USING (agent)"
      " WHERE a.kind = 'robot' ORDER BY p.agent, p.at_ns");
  while (query.next()) {
    run.tracks[static_cast<int>(query.integer(0))].push_back(
        {.at = static_cast<double>(query.integer(1)) / 1e9,  // exact for whole seconds
         .x = query.real(2),
         .y = query.real(3)});
  }
}

void read_network(RunReader& reader, RunResult& run) {
  Statement links = reader.query("SELECT a, b FROM links ORDER BY a, b");
  while (links.next()) {
    run.links.emplace_back(static_cast<int>(links.integer(0)), static_cast<int>(links.integer(1)));
  }
  Statement packets = reader.query("SELECT agent, SUM(count) FROM packets GROUP BY agent");
  while (packets.next()) {
    run.packets[static_cast<int>(packets.integer(0))] =
        static_cast<std::uint64_t>(packets.integer(1));
  }
}

void read_frame_verdicts(RunReader& reader, RunResult& run) {
  Statement sums = reader.query("SELECT class, addressed, verdict, count FROM verdict_sums");
  while (sums.next()) {
    run.frame_verdicts.push_back({.kind = sums.text(0),
                                  .addressed = sums.integer(1) != 0,
                                  .verdict = sums.text(2),
                                  .count = static_cast<std::uint64_t>(sums.integer(3))});
  }
  Statement links = reader.query(
      "SELECT peer, agent, verdict, SUM(count) FROM link_verdicts WHERE addressed"
      " GROUP BY 1, 2, 3 ORDER BY 1, 2, 3");
  while (links.next()) {
    const auto from = static_cast<int>(links.integer(0));
    if (!std::ranges::binary_search(run.agents, from, {}, &RunResult::Agent::agent)) {
      links.refuse(0, "no agent of this run");
    }
    run.link_verdicts.push_back({.from = from,
                                 .to = static_cast<int>(links.integer(1)),
                                 .verdict = links.text(2),
                                 .count = static_cast<std::uint64_t>(links.integer(3))});
  }
}

/// The members that count messages to several agents.
struct Broadcast {
  std::uint64_t RunResult::*sent;
  std::uint64_t RunResult::*received;
};

/// A message to everyone that routing relays is a flood. A message to neighbours, or any message
/// without routing, is sent once and is a broadcast. None: the message is to one agent.
std::optional<Broadcast> broadcast_of(const RunResult& run, std::int64_t destination) {
  const hal::AgentId to{static_cast<std::uint16_t>(destination)};
  if (!hal::is_broadcast(to)) return std::nullopt;
  const bool is_flood = to == hal::kEveryone && run.has_routing();
  return is_flood ? Broadcast{&RunResult::floods, &RunResult::flood_deliveries}
                  : Broadcast{&RunResult::broadcasts, &RunResult::broadcast_deliveries};
}

void read_messages(RunReader& reader, RunResult& run) {
  Statement ends =
      reader.query("SELECT destination, verdict, SUM(count) FROM message_ends GROUP BY 1, 2");
  while (ends.next()) {
    const auto number = static_cast<std::uint64_t>(ends.integer(2));
    if (const auto broadcast = broadcast_of(run, ends.integer(0))) {
      run.*broadcast->sent += number;
    } else {
      run.messages += number;
      run.verdicts[ends.text(1)] += number;
    }
  }
}

void read_delivery_sums(RunReader& reader, RunResult& run) {
  Statement sums = reader.query(
      "SELECT MAX(destination, 65533), IFNULL(transmissions, 0) AS transmissions, SUM(count),"
      " MIN(delay_least_ns) FROM message_deliveries GROUP BY 1, 2");
  while (sums.next()) {
    const auto number = static_cast<std::uint64_t>(sums.integer(2));
    if (const auto broadcast = broadcast_of(run, sums.integer(0))) {
      run.*broadcast->received += number;
    } else {
      run.delivered += number;
      RunResult::Hops& hops = run.hops[static_cast<int>(sums.integer(1))];
      hops.messages = number;
      if (!sums.is_null(3)) hops.least_delay_ns = sums.integer(3);
    }
  }
}

void read_deliveries(RunReader& reader, RunResult& run) {
  Statement deliveries = reader.query(
      "SELECT d.delay_ns, d.transmissions FROM deliveries d JOIN messages m USING (sender, id)"
      " WHERE m.destination < 65534 ORDER BY d.at_ns, d.sender, d.id");
  while (deliveries.next()) {
    RunResult::Delivery& delivery = run.deliveries.emplace_back();
    delivery.delay_ns = deliveries.integer(0);
    delivery.delay = static_cast<double>(delivery.delay_ns) * 1e-9;
    if (!deliveries.is_null(1)) delivery.transmissions = static_cast<int>(deliveries.integer(1));
  }
}

void read_discoveries(RunReader& reader, RunResult& run) {
  Statement query = reader.query("SELECT found, took_ns FROM discoveries ORDER BY rowid");
  while (query.next()) {
    if (query.integer(0) != 0) {
      run.discoveries_ns.push_back(query.integer(1));
    } else {
      ++run.discoveries_failed;
    }
  }
}

void read_routing_events(RunReader& reader, RunResult& run) {
  Statement query = reader.query(
      "SELECT event, SUM(n) AS count FROM (SELECT event, count AS n FROM routing_events"
      " UNION ALL SELECT word, 0 FROM countable WHERE family = 'routing.events')"
      " GROUP BY event ORDER BY event");
  while (query.next()) {
    run.routing_events[query.text(0)] = static_cast<std::uint64_t>(query.integer(1));
  }
}

std::optional<double> optional_real(const Statement& row, int column) {
  return row.is_null(column) ? std::nullopt : std::optional(row.real(column));
}

std::vector<RunResult::Values> values_of(Statement rows) {
  std::vector<RunResult::Values> all;
  while (rows.next()) {
    all.push_back({.agent = rows.text(0),
                   .name = rows.text(1),
                   .unit = rows.text(2),
                   .count = static_cast<std::uint64_t>(rows.integer(3)),
                   .mean = optional_real(rows, 4),
                   .least = optional_real(rows, 5),
                   .most = optional_real(rows, 6),
                   .last = optional_real(rows, 7)});
  }
  return all;
}

void read_recorded(RunReader& reader, RunResult& run) {
  run.recorded = values_of(reader.query(
      "WITH sums AS (SELECT agent, name, COUNT(*) AS count, AVG(value) AS mean, MIN(value) AS"
      " low, MAX(value) AS high, MAX(rowid) AS newest FROM recorded GROUP BY 1, 2)"
      " SELECT a.name, 'controllers.' || s.name, IFNULL(u.unit, ''), count, mean, low, high,"
      " (SELECT value FROM recorded r WHERE r.rowid = newest) FROM sums s JOIN agents a"
      " USING (agent) LEFT JOIN recorded_units u ON u.program = a.program AND u.name = s.name"
      " ORDER BY s.name, agent"));
  run.observables = values_of(
      reader.query("SELECT a.name, o.name, o.unit, IFNULL(s.count, 0), s.mean, s.min, s.max, s.last"
                   " FROM observables o JOIN agents a USING (agent) LEFT JOIN observable_sums s"
                   " USING (observable) ORDER BY o.name, o.agent, o.observable"));
  Statement states = reader.query(
      "SELECT a.name, state, COUNT(*), MIN(at_ns) FROM states JOIN agents a USING (agent)"
      " GROUP BY agent, state ORDER BY agent, 4, MIN(states.rowid)");
  while (states.next()) {
    run.states.push_back({.agent = states.text(0),
                          .state = states.text(1),
                          .entries = static_cast<std::uint64_t>(states.integer(2)),
                          .first = static_cast<double>(states.integer(3)) * 1e-9});
  }
}

void read_goal(RunReader& reader, RunResult& run) {
  Statement query = reader.query("SELECT agent FROM ends WHERE agent IS NOT NULL AND result = ?");
  query.bind_all(run.value("result"));
  if (query.next()) run.goal = static_cast<int>(query.integer(0));
}

}  // namespace

std::string RunResult::value(const std::string& key) const {
  const auto found = values.find(key);
  return found == values.end() ? std::string() : found->second;
}

bool RunResult::has_setting(const std::string& key, const std::string& wanted) const {
  const auto found = settings.find(key);
  return found != settings.end() && found->second == wanted;
}

double RunResult::number(const std::string& key) const {
  return std::strtod(value(key).c_str(), nullptr);
}

std::string RunResult::ending() const {
  const std::string result = value("result");
  return result == "running" ? "unfinished" : result;
}

bool RunResult::is_complete() const {
  const std::string result = ending();
  return result != "unfinished" && result != "failed" && result != "interrupted" &&
         result != "not started";
}

RunResult read_run(const fs::path& folder) {
  RunReader reader(folder);
  RunResult run;
  run.folder = folder.string();
  read_values(reader, run);
  read_agents(reader, run);
  read_bodies(reader, run);
  read_walls(reader, run);
  read_tracks(reader, run);
  read_network(reader, run);
  read_frame_verdicts(reader, run);
  read_messages(reader, run);
  read_delivery_sums(reader, run);
  read_deliveries(reader, run);
  read_discoveries(reader, run);
  read_routing_events(reader, run);
  read_air_use(reader, run);
  read_recorded(reader, run);
  read_goal(reader, run);
  return run;
}

}  // namespace results::report
