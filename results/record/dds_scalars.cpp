#include "results/record/dds_scalars.h"

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace results::record {
namespace {

constexpr std::string_view kSamplesAreCounted =
    "EXISTS (SELECT 1 FROM countable WHERE family = 'dds.lost')";

/// Sums of samples by topic and reading agent; agent 0: of all. Topics and readers are those that
/// were announced, also if nothing was sent to them.
constexpr std::string_view kSums =
    "sent AS (SELECT e.topic, s.receiver AS agent, SUM(s.samples) AS samples,"
    " SUM(s.delivered) AS delivered, SUM(s.first_try) AS first_try, SUM(s.under_way) AS under_way,"
    " SUM(s.repairs) AS repairs, SUM(s.latency_sum_ns) AS latency_sum_ns"
    " FROM sample_sums s JOIN dds_endpoints e ON e.guid = s.writer GROUP BY 1, 2),"
    " readers AS (SELECT DISTINCT topic, 0 AS agent FROM dds_endpoints"
    " UNION SELECT topic, agent FROM dds_endpoints WHERE kind = 'reader' AND agent IS NOT NULL),"
    " sums AS (SELECT r.topic, r.agent, IFNULL(SUM(samples), 0) AS samples,"
    " IFNULL(SUM(delivered), 0) AS delivered, IFNULL(SUM(first_try), 0) AS first_try,"
    " IFNULL(SUM(under_way), 0) AS under_way, IFNULL(SUM(repairs), 0) AS repairs,"
    " SUM(latency_sum_ns) AS latency_sum_ns FROM readers r LEFT JOIN sent s ON s.topic = r.topic"
    " AND (r.agent = 0 OR s.agent = r.agent) GROUP BY 1, 2)";

/// @param value  of the columns of kSums.
std::string of_sums(std::string_view value) {
  return fmt::format(
      "WITH {} SELECT IFNULL(name, ''), {}, topic FROM sums LEFT JOIN agents a ON a.agent ="
      " sums.agent WHERE {} ORDER BY topic, sums.agent",
      kSums, value, kSamplesAreCounted);
}

/// The lowest bin up to which at least that share of the latencies lies, by its lower edge and half
/// its width: sim::air::LatencyHistogram. As results::report::latency_quantile().
std::string latency_quantile(double share) {
  return fmt::format(
      "WITH bins AS (SELECT e.topic, receiver AS agent, least_ns, count FROM sample_latencies l"
      " JOIN dds_endpoints e ON e.guid = l.writer),"
      " both AS (SELECT topic, agent, least_ns, SUM(count) AS n FROM bins GROUP BY 1, 2, 3"
      " UNION ALL SELECT topic, 0, least_ns, SUM(count) FROM bins GROUP BY 1, 3),"
      " below AS (SELECT topic, agent, least_ns, SUM(n) OVER (PARTITION BY topic, agent"
      " ORDER BY least_ns) AS upto, SUM(n) OVER (PARTITION BY topic, agent) AS every FROM both)"
      " SELECT IFNULL(name, ''), MIN(least_ns) * (1 + 1.0 / 64) * 1e-9, topic FROM below b"
      " LEFT JOIN agents a ON a.agent = b.agent WHERE upto >= {} * every"
      " GROUP BY topic, b.agent ORDER BY topic, b.agent",
      share);
}

/// Air time by topic and transmitter; agent 0: of all. Agents that were announced as readers or
/// writers of a topic have one, also if it is 0.
/// @param value  of s, the air time in s.
std::string of_airtime(std::string_view value) {
  return fmt::format(
      "WITH spent AS (SELECT topic, agent, SUM(airtime_ns) * 1e-9 AS s FROM air_accounts"
      " WHERE purpose = 'user' AND topic IS NOT NULL GROUP BY 1, 2),"
      " places AS (SELECT topic, 0 AS agent FROM dds_endpoints UNION SELECT topic, agent"
      " FROM dds_endpoints WHERE agent IS NOT NULL UNION SELECT topic, agent FROM spent"
      " UNION SELECT topic, 0 FROM spent),"
      " sums AS (SELECT p.topic, p.agent, IFNULL(SUM(s), 0.0) AS s FROM places p LEFT JOIN spent x"
      " ON x.topic = p.topic AND (p.agent = 0 OR x.agent = p.agent) GROUP BY 1, 2)"
      " SELECT IFNULL(name, ''), {}, topic FROM sums LEFT JOIN agents a ON a.agent = sums.agent"
      " ORDER BY topic, sums.agent",
      value);
}

constexpr std::string_view kShareOfTime =
    "s / NULLIF((SELECT value FROM run WHERE key = 'simulated_s'), 0)";

std::string of_purposes(std::string_view value) {
  return fmt::format(
      "SELECT '', {}, word FROM (SELECT word, SUM(s) AS s FROM (SELECT purpose AS word,"
      " airtime_ns * 1e-9 AS s FROM air_accounts UNION ALL SELECT word, 0.0 FROM countable"
      " WHERE family = 'air') GROUP BY 1) ORDER BY word",
      value);
}

std::string total(std::string_view value) {
  return fmt::format("SELECT '', {} FROM sample_sums HAVING {}", value, kSamplesAreCounted);
}

/// Lost samples by topic and cause, also 0.
std::string of_losses() {
  return fmt::format(
      "SELECT '', IFNULL(SUM(l.count), 0), t.topic, w.verdict"
      " FROM (SELECT DISTINCT topic FROM dds_endpoints) t JOIN (SELECT word AS verdict"
      " FROM countable WHERE family = 'dds.lost' UNION SELECT verdict FROM"
      " sample_losses) w LEFT JOIN (SELECT topic, verdict, count FROM sample_losses"
      " JOIN dds_endpoints ON guid = writer) l ON l.topic = t.topic AND l.verdict ="
      " w.verdict WHERE {} GROUP BY 3, 4 ORDER BY 3, 4",
      kSamplesAreCounted);
}

std::vector<ScalarKind> total_scalars() {
  return {
      {"dds.samples", "1",
       "samples that programs' writers sent, counted once for each other agent with a matched "
       "reader; this and the following numbers only in runs in which an agent has a network",
       total("IFNULL(SUM(samples), 0)")},
      {"dds.delivered", "1", "samples among these that arrived completely",
       total("IFNULL(SUM(delivered), 0)")},
      {"dds.delivered_share", "1", "delivered over samples; absent if there were none",
       total("1.0 * SUM(delivered) / NULLIF(SUM(samples), 0)"), Range::kShare, "dds.samples"},
  };
}

std::vector<ScalarKind> sample_scalars() {
  return {
      {"dds.TOPIC.samples", "1",
       "the same by topic, in total and of each reading agent; 0 for a topic or a reader that was "
       "announced and to which nothing was sent",
       of_sums("samples"), Range::kCount, "", true},
      {"dds.TOPIC.delivered", "1", "samples among these that arrived completely",
       of_sums("delivered"), Range::kCount, "", true},
      {"dds.TOPIC.delivered_share", "1", "delivered over samples; absent if there were none",
       of_sums("1.0 * delivered / NULLIF(samples, 0)"), Range::kShare, "dds.TOPIC.samples"},
      {"dds.TOPIC.first_try_share", "1",
       "share of the samples that were delivered without DDS having sent any part of them again",
       of_sums("1.0 * first_try / NULLIF(samples, 0)"), Range::kShare, "dds.TOPIC.samples"},
      {"dds.TOPIC.repaired", "1", "the other delivered samples", of_sums("delivered - first_try"),
       Range::kCount, "", true},
      {"dds.TOPIC.repairs", "1", "samples, or RTPS fragments, that DDS sent again",
       of_sums("repairs"), Range::kCount, "", true},
      {"dds.TOPIC.under_way", "1", "samples neither delivered nor lost at the end of the run",
       of_sums("under_way"), Range::kCount, "", true},
      {"dds.TOPIC.lost.VERDICT", "1",
       "samples that were lost, by the outcome of the last frame that carried a missing part, as "
       "in the table sample_losses",
       of_losses(), Range::kCount, "", true},
  };
}

std::vector<ScalarKind> time_scalars() {
  return {
      {"dds.TOPIC.latency.mean", "s",
       "mean time of the delivered samples from the interface of the writer's agent to that of the "
       "reader's",
       of_sums("latency_sum_ns * 1e-9 / NULLIF(delivered, 0)")},
      {"dds.TOPIC.latency.p50", "s",
       "median, from the table sample_latencies: at most 1/64 from the time of a sample of that "
       "rank, as the next two",
       latency_quantile(0.5)},
      {"dds.TOPIC.latency.p95", "s", "95th percentile", latency_quantile(0.95)},
      {"dds.TOPIC.latency.p99", "s", "99th percentile", latency_quantile(0.99)},
      {"dds.TOPIC.airtime", "s",
       "time on the air of the topic: data, heartbeats and acknowledgements, in total and of each "
       "transmitting agent, which may be an access point",
       of_airtime("s"), Range::kNotNegative, "", true},
      {"dds.TOPIC.air_share", "1",
       "the same over the simulated time; several agents can transmit at the same time",
       of_airtime(kShareOfTime), Range::kNotNegative, "", true},
      {"air.PURPOSE.airtime", "s",
       "time on the air by purpose, as in the table air_accounts: air.user.airtime, "
       "air.sedp.airtime, air.802_11.airtime",
       of_purposes("s")},
      {"air.PURPOSE.air_share", "1", "the same over the simulated time", of_purposes(kShareOfTime),
       Range::kNotNegative},
  };
}

}  // namespace

std::vector<ScalarKind> dds_scalars() {
  std::vector<ScalarKind> all;
  for (const auto& part : {total_scalars(), sample_scalars(), time_scalars()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace results::record
