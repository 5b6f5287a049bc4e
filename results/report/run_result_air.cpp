#include "results/report/run_result_air.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace results::report {
namespace {

using record::RunReader;
using record::Statement;

void read_air_topics(RunReader& reader, RunResult& run) {
  Statement topics = reader.query(
      "SELECT topic, samples, delivered, first_try, repaired, airtime_ns FROM air_topics"
      " ORDER BY topic");
  while (topics.next()) {
    run.air_topics.push_back({.topic = topics.text(0),
                              .samples = static_cast<std::uint64_t>(topics.integer(1)),
                              .delivered = static_cast<std::uint64_t>(topics.integer(2)),
                              .first_try = static_cast<std::uint64_t>(topics.integer(3)),
                              .repaired = static_cast<std::uint64_t>(topics.integer(4)),
                              .airtime_ns = topics.integer(5)});
  }
  Statement latencies = reader.query(
      "SELECT e.topic, l.least_ns, SUM(l.count) FROM sample_latencies l"
      " JOIN dds_endpoints e ON e.guid = l.writer GROUP BY 1, 2");
  while (latencies.next()) {
    const auto topic =
        std::ranges::find(run.air_topics, latencies.text(0), &RunResult::AirTopic::topic);
    if (topic == run.air_topics.end()) continue;
    topic->latencies[latencies.integer(1)] = static_cast<std::uint64_t>(latencies.integer(2));
  }
}

void read_air(RunReader& reader, RunResult& run) {
  Statement kinds = reader.query(
      "SELECT purpose, kind, port, frames, retries, submessages + repeated AS submessages, bits, "
      "airtime_ns"
      " FROM air_kinds ORDER BY airtime_ns DESC, purpose, kind, port");
  while (kinds.next()) {
    RunResult::AirKind& kind = run.air_kinds.emplace_back();
    kind.purpose = kinds.text(0);
    kind.kind = kinds.text(1);
    if (!kinds.is_null(2)) kind.port = static_cast<int>(kinds.integer(2));
    kind.frames = static_cast<std::uint64_t>(kinds.integer(3));
    kind.retries = static_cast<std::uint64_t>(kinds.integer(4));
    kind.submessages = static_cast<std::uint64_t>(kinds.integer(5));
    kind.bits = static_cast<std::uint64_t>(kinds.integer(6));
    kind.airtime_ns = kinds.integer(7);
  }
  Statement seconds =
      reader.query("SELECT second, purpose, kind, airtime_ns FROM air_seconds ORDER BY 1, 2, 3");
  while (seconds.next()) {
    run.air_seconds.push_back({.second = seconds.integer(0),
                               .purpose = seconds.text(1),
                               .kind = seconds.text(2),
                               .airtime_ns = seconds.integer(3)});
  }
}

void read_relays(RunReader& reader, RunResult& run) {
  std::map<std::pair<int, int>, RunResult::Relay> relays;
  const auto at = [&relays](const Statement& row) -> RunResult::Relay& {
    const auto agent = static_cast<int>(row.integer(0));
    const auto destination = static_cast<int>(row.integer(1));
    RunResult::Relay& relay = relays[{agent, destination}];
    relay.access_point = agent;
    relay.destination = destination;
    return relay;
  };
  Statement counts =
      reader.query("SELECT agent, destination, verdict, SUM(count) FROM relays GROUP BY 1, 2, 3");
  while (counts.next()) {
    at(counts).verdicts[counts.text(2)] = static_cast<std::uint64_t>(counts.integer(3));
  }
  Statement queues =
      reader.query("SELECT agent, destination, frames, most, waited_ns FROM relay_queues");
  while (queues.next()) {
    RunResult::Relay& relay = at(queues);
    relay.queued = static_cast<std::uint64_t>(queues.integer(2));
    relay.most = static_cast<std::uint64_t>(queues.integer(3));
    relay.waited_ns = queues.integer(4);
  }
  run.relays.reserve(relays.size());
  for (auto& [key, relay] : relays) run.relays.push_back(std::move(relay));
}

void read_queues(RunReader& reader, RunResult& run) {
  std::map<std::tuple<int, int, std::string>, RunResult::Queue> queues;
  const auto at = [&queues](const Statement& row) -> RunResult::Queue& {
    const auto agent = static_cast<int>(row.integer(0));
    const auto receiver = static_cast<int>(row.integer(1));
    RunResult::Queue& queue = queues[{agent, receiver, row.text(2)}];
    queue.agent = agent;
    queue.receiver = receiver;
    queue.category = row.text(2);
    return queue;
  };
  Statement held = reader.query(
      "SELECT agent, receiver, category, frames, waiting, most, most_bytes, waited_ns"
      " FROM station_queues");
  while (held.next()) {
    RunResult::Queue& queue = at(held);
    queue.frames = static_cast<std::uint64_t>(held.integer(3));
    queue.waiting = static_cast<std::uint64_t>(held.integer(4));
    queue.most = static_cast<std::uint64_t>(held.integer(5));
    queue.most_bytes = static_cast<std::uint64_t>(held.integer(6));
    queue.waited_ns = held.integer(7);
  }
  Statement drops =
      reader.query("SELECT agent, receiver, category, verdict, count FROM station_queue_drops");
  while (drops.next()) {
    at(drops).drops[drops.text(3)] = static_cast<std::uint64_t>(drops.integer(4));
  }
  run.queues.reserve(queues.size());
  for (auto& [key, queue] : queues) run.queues.push_back(std::move(queue));
}

void read_sample_losses(RunReader& reader, RunResult& run) {
  Statement losses = reader.query(
      "SELECT e.topic, l.verdict, l.agent, SUM(l.count) FROM sample_losses l"
      " JOIN dds_endpoints e ON e.guid = l.writer GROUP BY 1, 2, 3 ORDER BY 1, 2, 3");
  while (losses.next()) {
    run.sample_losses.push_back({.topic = losses.text(0),
                                 .verdict = losses.text(1),
                                 .agent = static_cast<int>(losses.integer(2)),
                                 .count = static_cast<std::uint64_t>(losses.integer(3))});
  }
}

}  // namespace

void read_air_use(RunReader& reader, RunResult& run) {
  read_air_topics(reader, run);
  read_air(reader, run);
  read_relays(reader, run);
  read_queues(reader, run);
  read_sample_losses(reader, run);
}

}  // namespace results::report
