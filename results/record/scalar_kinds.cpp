// The scalars that every run has. The file is long because it lists them all.
#include <fmt/format.h>

#include "results/record/dds_scalars.h"
#include "results/record/scalars.h"

namespace results::record {
namespace {

/// Count of each word, including 0 for words that were possible but did not occur.
/// @param counted  SELECT of words and counts, as `word` and `n`.
std::string with_zeros(std::string_view counted, std::string_view family) {
  return fmt::format(
      "SELECT '', SUM(n), word FROM ({} UNION ALL SELECT word, 0 FROM countable"
      " WHERE family = '{}') GROUP BY 3 ORDER BY 3",
      counted, family);
}

/// A sum, only for runs that count that family. @param select  selects one row.
std::string if_counted(std::string_view select, std::string_view family) {
  return fmt::format("{} HAVING EXISTS (SELECT 1 FROM countable WHERE family = '{}')", select,
                     family);
}

constexpr std::string_view kFramesFamily = "frames";
constexpr std::string_view kMessagesFamily = "messages.ends";

std::vector<ScalarKind> run_scalars() {
  return {
      {"run.simulated", "s", "simulated time at the end of the run",
       "SELECT '', value FROM run WHERE key = 'simulated_s'"},
      {"run.events", "1", "events that the simulator processed",
       "SELECT '', value FROM run WHERE key = 'events'"},
      {"run.refused_actions", "1", "actions of controllers that were rejected",
       "SELECT '', value FROM run WHERE key = 'refused_actions'"},
  };
}

constexpr std::string_view kDelays =
    "SELECT delay_ns * 1e-9 AS v FROM deliveries JOIN messages USING (sender, id)"
    " WHERE destination < 65534";
constexpr std::string_view kSearches = "SELECT took_ns * 1e-9 AS v FROM discoveries WHERE found";

/// Quantile of type 7 (R. J. Hyndman and Y. Fan, "Sample Quantiles in Statistical Packages", The
/// American Statistician 50(4), 1996). The p-quantile of n sorted values is at position (n - 1) p,
/// counted from 0, interpolated linearly: each value has the weight max(0, 1 - |its position - that
/// position|).
std::string quantile(std::string_view of, double p) {
  return fmt::format(
      "WITH sorted AS (SELECT v, ROW_NUMBER() OVER (ORDER BY v) - 1 AS place,"
      " (COUNT(*) OVER () - 1) * {} AS wanted FROM ({}))"
      " SELECT '', SUM(v * MAX(0, 1 - ABS(place - wanted))) FROM sorted",
      p, of);
}

std::vector<ScalarKind> message_scalars() {
  return {
      {"messages.sent", "1", "messages to a single agent that controllers sent",
       if_counted("SELECT '', IFNULL(SUM(count), 0) FROM message_ends WHERE destination < 65534",
                  kMessagesFamily)},
      {"messages.delivered", "1", "messages among these that arrived",
       if_counted(
           "SELECT '', IFNULL(SUM(count), 0) FROM message_deliveries WHERE destination < 65534",
           kMessagesFamily)},
      {"messages.delivery_ratio", "1", "delivered messages over sent messages",
       "SELECT '', 1.0 * (SELECT IFNULL(SUM(count), 0) FROM message_deliveries"
       " WHERE destination < 65534) / SUM(count) FROM message_ends WHERE destination < 65534",
       Range::kShare, "messages.sent"},
      {"messages.goodput", "bit/s", "payload of the delivered messages over the simulated time",
       if_counted("SELECT '', 8.0 * IFNULL(SUM(bytes), 0) / (SELECT value FROM run WHERE key = "
                  "'simulated_s')"
                  " FROM message_deliveries WHERE destination < 65534",
                  kMessagesFamily)},
      {"messages.delay.mean", "s",
       "mean time from sending to arrival, waiting for a route included",
       "SELECT '', SUM(delay_sum_ns) * 1e-9 / SUM(count - late) FROM message_deliveries"
       " WHERE destination < 65534"},
      {"messages.delay.median", "s",
       "median of that time; only with record: {messages: sample} or all, as the next two",
       quantile(kDelays, 0.5)},
      {"messages.delay.p95", "s", "95th percentile", quantile(kDelays, 0.95)},
      {"messages.delay.p99", "s", "99th percentile", quantile(kDelays, 0.99)},
      {"messages.delay.max", "s", "maximum",
       "SELECT '', MAX(delay_greatest_ns) * 1e-9 FROM message_deliveries WHERE destination < "
       "65534"},
      {"messages.transmissions.mean", "1",
       "mean number of hops of delivered messages, as far as known; retransmissions on a hop do "
       "not count",
       "SELECT '', 1.0 * SUM(transmissions * count) / SUM(count) FROM message_deliveries"
       " WHERE destination < 65534 AND transmissions > 0",
       Range::kNotNegative},
      {"messages.ends.VERDICT", "1",
       "messages to a single agent with this outcome: messages.ends.no_route",
       with_zeros("SELECT verdict AS word, count AS n FROM message_ends WHERE destination < 65534",
                  kMessagesFamily)},
  };
}

std::vector<ScalarKind> broadcast_scalars() {
  return {
      {"broadcasts.sent", "1", "messages to everyone or to neighbours",
       if_counted("SELECT '', IFNULL(SUM(messages), 0) FROM broadcast_sums", kMessagesFamily)},
      {"broadcasts.addressees", "1",
       "addressees of these messages in total: for each message all other agents",
       if_counted("SELECT '', IFNULL(SUM(addressees), 0) FROM broadcast_sums", kMessagesFamily)},
      {"broadcasts.deliveries", "1", "addressees among these that received the message",
       if_counted("SELECT '', IFNULL(SUM(reached), 0) FROM broadcast_sums", kMessagesFamily)},
      {"broadcasts.reach", "1", "deliveries over addressees",
       "SELECT '', 1.0 * SUM(reached) / NULLIF(SUM(addressees), 0) FROM broadcast_sums",
       Range::kShare, "broadcasts.addressees"},
  };
}

std::vector<ScalarKind> topic_scalars() {
  return {
      {"topics.TOPIC.sent", "1", "messages to a single agent on this topic",
       "SELECT '', SUM(count), topic FROM message_ends WHERE destination < 65534 GROUP BY 3"
       " ORDER BY 3",
       Range::kCount, "", true},
      {"topics.TOPIC.delivered", "1", "messages among these that arrived",
       "SELECT '', IFNULL((SELECT SUM(count) FROM message_deliveries d WHERE d.topic = e.topic"
       " AND d.destination < 65534), 0), topic FROM message_ends e WHERE destination < 65534"
       " GROUP BY 3 ORDER BY 3",
       Range::kCount, "", true},
      {"topics.TOPIC.delay.mean", "s", "as messages.delay.mean, for this topic",
       "SELECT '', SUM(delay_sum_ns) * 1e-9 / SUM(count - late), topic FROM message_deliveries"
       " WHERE destination < 65534 GROUP BY 3 ORDER BY 3"},
  };
}

std::vector<ScalarKind> network_scalars() {
  return {
      {"discoveries.found", "1", "route discoveries that found a route",
       "SELECT '', IFNULL(SUM(found), 0) FROM discoveries"},
      {"discoveries.failed", "1", "route discoveries that were given up",
       "SELECT '', IFNULL(SUM(NOT found), 0) FROM discoveries"},
      {"discoveries.time.mean", "s", "mean duration of the discoveries that found a route",
       "SELECT '', AVG(took_ns) * 1e-9 FROM discoveries WHERE found"},
      {"discoveries.time.median", "s", "median", quantile(kSearches, 0.5)},
      {"discoveries.time.p95", "s", "95th percentile", quantile(kSearches, 0.95)},
      {"discoveries.time.p99", "s", "99th percentile", quantile(kSearches, 0.99)},
      {"frames.sent", "1", "frames sent, acknowledgements and retransmissions included",
       if_counted("SELECT '', IFNULL(SUM(count), 0) FROM frames_sent", kFramesFamily)},
      {"frames.CLASS", "1", "frames sent of this class: frames.broadcast, frames.ack",
       with_zeros("SELECT class AS word, count AS n FROM frames_sent", kFramesFamily)},
      {"frames.retries", "1", "retransmissions among them",
       "SELECT '', SUM(retries) FROM agent_use"},
      {"frames.airtime", "s", "total time on the air of the frames of all radios",
       "SELECT '', SUM(transmitting_ns) * 1e-9 FROM agent_use"},
      {"receptions.VERDICT", "1",
       "receptions with this outcome at radios that the frame was addressed to: "
       "receptions.delivered, receptions.collision",
       with_zeros("SELECT verdict AS word, count AS n FROM verdict_sums WHERE addressed",
                  "receptions")},
      {"requests.VERDICT", "1",
       "transmission requests to the link layer with this outcome: requests.delivered, "
       "requests.retry_limit",
       with_zeros("SELECT verdict AS word, count AS n FROM requests", "requests")},
      {"routing.events.EVENT", "1",
       "events of this kind in the routing protocols of all agents: routing.events.rreq_sent",
       with_zeros("SELECT event AS word, count AS n FROM routing_events", "routing.events")},
  };
}

std::vector<ScalarKind> body_scalars() {
  return {
      {"paths.sum", "m", "total distance travelled by all robots",
       "SELECT '', SUM(path_m) FROM bodies JOIN agents USING (agent) WHERE kind = 'robot'"},
      {"paths.mean", "m", "mean distance travelled by a robot",
       "SELECT '', AVG(path_m) FROM bodies JOIN agents USING (agent) WHERE kind = 'robot'"},
      {"agents.path", "m", "distance travelled by the robot",
       "SELECT name, path_m FROM bodies JOIN agents USING (agent) WHERE kind = 'robot'"
       " ORDER BY agent"},
      {"agents.clearance", "m",
       "smallest distance from the robot's centre to the surface of a wall",
       "SELECT name, clearance_m FROM bodies JOIN agents USING (agent) WHERE kind = 'robot'"
       " ORDER BY agent"},
      {"agents.wall_steps", "1", "physics steps in which the robot touched a wall",
       "SELECT name, wall_steps FROM bodies JOIN agents USING (agent) WHERE kind = 'robot'"
       " ORDER BY agent"},
      {"agents.object_steps", "1", "physics steps in which the robot touched another body",
       "SELECT name, object_steps FROM bodies JOIN agents USING (agent) WHERE kind = 'robot'"
       " ORDER BY agent"},
  };
}

/// The states that controllers of agents have reported, and those that they could have reported.
constexpr const char* kPossibleStates =
    "possible AS (SELECT agent, word AS state FROM agents JOIN countable USING (program)"
    " WHERE family = 'states' UNION SELECT agent, state FROM states)";

std::string time_of_states() {
  return fmt::format(
      "WITH {}, stays AS (SELECT agent, state, at_ns, IFNULL(LEAD(at_ns) OVER (PARTITION BY agent"
      " ORDER BY rowid), (SELECT value FROM run WHERE key = 'ended_ns')) - at_ns AS stay_ns"
      " FROM states), sums AS (SELECT agent, state, SUM(stay_ns) * 1e-9 AS s FROM stays"
      " GROUP BY 1, 2)"
      " SELECT name, CASE WHEN sums.agent IS NULL THEN 0 ELSE s END, p.state FROM possible p"
      " JOIN agents a ON a.agent = p.agent"
      " LEFT JOIN sums ON sums.agent = p.agent AND sums.state = p.state ORDER BY p.state, p.agent",
      kPossibleStates);
}

std::string entries_of_states() {
  return fmt::format(
      "WITH {}, sums AS (SELECT agent, state, COUNT(*) AS n FROM states GROUP BY 1, 2)"
      " SELECT name, IFNULL(n, 0), p.state FROM possible p JOIN agents a ON a.agent = p.agent"
      " LEFT JOIN sums ON sums.agent = p.agent AND sums.state = p.state ORDER BY p.state, p.agent",
      kPossibleStates);
}

constexpr const char* kRecordedCounts =
    "WITH possible AS (SELECT agent, word AS name FROM agents JOIN countable USING (program)"
    " WHERE family = 'controllers' UNION SELECT agent, name FROM recorded),"
    " sums AS (SELECT agent, name, COUNT(*) AS n FROM recorded GROUP BY 1, 2)"
    " SELECT a.name, IFNULL(n, 0), p.name FROM possible p JOIN agents a ON a.agent = p.agent"
    " LEFT JOIN sums ON sums.agent = p.agent AND sums.name = p.name ORDER BY p.name, p.agent";

std::vector<ScalarKind> controller_scalars() {
  return {
      {"states.STATE.time", "s", "total time that the agent's controller was in this state",
       time_of_states(), Range::kNotNegative, "", true},
      {"states.STATE.entries", "1",
       "number of times that the agent's controller entered this state", entries_of_states(),
       Range::kCount, "", true},
      {"states.STATE.first", "s", "time at which the agent's controller first entered this state",
       "SELECT name, MIN(at_ns) * 1e-9, state FROM states JOIN agents USING (agent)"
       " GROUP BY agent, state ORDER BY state, agent"},
      {"controllers.NAME.count", "1",
       "number of values that the agent's controller recorded under this name", kRecordedCounts,
       Range::kCount, "", true},
      {"controllers.NAME.mean", "", "mean of these values, in the unit of the controller",
       "SELECT a.name, AVG(value), r.name FROM recorded r JOIN agents a USING (agent)"
       " GROUP BY r.agent, r.name ORDER BY r.name, r.agent"},
      {"controllers.NAME.min", "", "smallest of these values",
       "SELECT a.name, MIN(value), r.name FROM recorded r JOIN agents a USING (agent)"
       " GROUP BY r.agent, r.name ORDER BY r.name, r.agent"},
      {"controllers.NAME.max", "", "largest of these values",
       "SELECT a.name, MAX(value), r.name FROM recorded r JOIN agents a USING (agent)"
       " GROUP BY r.agent, r.name ORDER BY r.name, r.agent"},
      {"controllers.NAME.last", "", "last of these values",
       "SELECT name, value, recorded_name FROM (SELECT a.name, value, r.name AS recorded_name,"
       " r.agent, ROW_NUMBER() OVER (PARTITION BY r.agent, r.name ORDER BY r.rowid DESC) AS back"
       " FROM recorded r JOIN agents a USING (agent)) WHERE back = 1"
       " ORDER BY recorded_name, agent"},
  };
}

std::vector<ScalarKind> use_scalars() {
  constexpr std::string_view kShare =
      "SELECT name, 1.0 * {} / NULLIF(transmitting_ns + receiving_ns + listening_ns + off_ns, 0)"
      " FROM agent_use JOIN agents USING (agent) ORDER BY agent";
  return {
      {"use.transmitting", "1", "share of the run in which the agent's radio transmitted",
       fmt::format(kShare, "transmitting_ns"), Range::kShare},
      {"use.receiving", "1", "share of the run in which it found the medium busy because of others",
       fmt::format(kShare, "receiving_ns"), Range::kShare},
      {"use.off", "1", "share of the run in which it was off", fmt::format(kShare, "off_ns"),
       Range::kShare},
      {"use.retries", "1", "retransmissions of the agent",
       "SELECT name, retries FROM agent_use JOIN agents USING (agent) ORDER BY agent"},
      {"use.energy", "J",
       "energy drawn from the agent's battery by computer, radio and motors, including losses in "
       "the battery; never more than it contained",
       "SELECT name, energy_j FROM agent_use JOIN agents USING (agent) ORDER BY agent"},
      {"energy.sum", "J", "sum of the previous number over all agents with a battery",
       "SELECT '', SUM(energy_j) FROM agent_use"},
      {"use.load", "J",
       "energy that the agent's computer, radio and motors demanded, even while the battery was "
       "empty",
       "SELECT name, load_j FROM agent_use JOIN agents USING (agent) ORDER BY agent"},
      {"load.sum", "J", "sum of the previous number over all agents with a battery",
       "SELECT '', SUM(load_j) FROM agent_use"},
  };
}

}  // namespace

const std::vector<ScalarKind>& scalar_kinds() {
  static const std::vector<ScalarKind> all = [] {
    std::vector<ScalarKind> sum;
    for (const auto& part :
         {run_scalars(), message_scalars(), broadcast_scalars(), topic_scalars(), network_scalars(),
          dds_scalars(), body_scalars(), use_scalars(), controller_scalars()}) {
      sum.insert(sum.end(), part.begin(), part.end());
    }
    return sum;
  }();
  return all;
}

}  // namespace results::record
