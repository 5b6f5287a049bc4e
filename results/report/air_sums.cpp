#include "results/report/air_sums.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace results::report {

std::vector<TopicSums> topic_sums(const Group& group) {
  std::map<std::string, TopicSums> sums;
  for (const RunResult* run : group.runs) {
    for (const RunResult::AirTopic& one : run->air_topics) {
      TopicSums& sum = sums[one.topic];
      sum.topic = one.topic;
      sum.samples += one.samples;
      sum.delivered += one.delivered;
      sum.first_try += one.first_try;
      sum.repaired += one.repaired;
      sum.airtime_ns += one.airtime_ns;
      for (const auto& [edge, count] : one.latencies) sum.latencies[edge] += count;
    }
  }
  std::vector<TopicSums> topics;
  topics.reserve(sums.size());
  for (auto& [name, sum] : sums) topics.push_back(std::move(sum));
  return topics;
}

std::vector<RunResult::AirKind> kind_sums(const Group& group) {
  std::map<std::tuple<std::string, std::string, std::optional<int>>, RunResult::AirKind> sums;
  for (const RunResult* run : group.runs) {
    for (const RunResult::AirKind& one : run->air_kinds) {
      RunResult::AirKind& sum = sums[{one.purpose, one.kind, one.port}];
      sum.purpose = one.purpose;
      sum.kind = one.kind;
      sum.port = one.port;
      sum.frames += one.frames;
      sum.retries += one.retries;
      sum.submessages += one.submessages;
      sum.bits += one.bits;
      sum.airtime_ns += one.airtime_ns;
    }
  }
  std::vector<RunResult::AirKind> kinds;
  kinds.reserve(sums.size());
  for (auto& [key, sum] : sums) kinds.push_back(std::move(sum));
  std::ranges::stable_sort(kinds, std::ranges::greater{}, &RunResult::AirKind::airtime_ns);
  return kinds;
}

std::int64_t airtime_of(const std::vector<RunResult::AirKind>& kinds) {
  std::int64_t sum = 0;
  for (const RunResult::AirKind& kind : kinds) sum += kind.airtime_ns;
  return sum;
}

std::optional<double> latency_quantile(const std::map<std::int64_t, std::uint64_t>& latencies,
                                       double share) {
  std::uint64_t all = 0;
  for (const auto& [edge, count] : latencies) all += count;
  if (all == 0) return std::nullopt;
  const auto wanted = std::max<std::uint64_t>(
      1, static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(all))));
  std::uint64_t below = 0;
  for (const auto& [edge, count] : latencies) {
    below += count;
    if (below >= wanted) return static_cast<double>(edge) * (1 + 1.0 / 64) * 1e-9;
  }
  return std::nullopt;
}

std::string use_of(const std::string& purpose, const std::string& kind) {
  if (purpose != "user") return purpose;
  return kind == "DATA" || kind == "DATA_FRAG" ? "user data" : "user control";
}

}  // namespace results::report
