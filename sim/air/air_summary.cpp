#include "sim/air/air_summary.h"

#include <map>

namespace sim::air {
namespace {

struct TopicTotal {
  TopicUse use;
  std::map<LatencyHistogram::Bin, std::uint64_t> latencies;
};

hal::Duration quantile(const TopicTotal& total, double share) {
  std::uint64_t below = 0;
  for (const auto& [bin, count] : total.latencies) {
    below += count;
    if (static_cast<double>(below) >= share * static_cast<double>(total.use.delivered))
      return LatencyHistogram::edge(bin);
  }
  return {};
}

double share_of(hal::Duration part, hal::Duration whole) {
  return whole.count() == 0
             ? 0
             : static_cast<double>(part.count()) / static_cast<double>(whole.count());
}

hal::Duration all_airtime(const Ledger& ledger) {
  hal::Duration sum{};
  for (const AirAccount& account : ledger.accounts().all()) sum += account.airtime;
  return sum;
}

void add(const SampleSums& sums, TopicTotal& total) {
  total.use.samples += sums.samples;
  total.use.delivered += sums.delivered;
  total.use.first_try += sums.first_try;
  for (const auto& [bin, count] : sums.latencies.counts()) total.latencies[bin] += count.times;
}

}  // namespace

std::vector<TopicUse> topics_of(const Ledger& ledger) {
  const Endpoints& endpoints = ledger.endpoints();
  std::map<std::uint32_t, TopicTotal> totals;
  for (const AirAccount& account : ledger.accounts().all()) {
    if (account.kind.purpose == Purpose::kUser)
      totals[account.kind.topic].use.airtime += account.airtime;
  }
  for (const auto& [key, sums] : ledger.samples().sums())
    add(sums, totals[endpoints.all()[key.first].topic]);
  const hal::Duration all = all_airtime(ledger);
  std::vector<TopicUse> topics;
  for (auto& [number, total] : totals) {
    total.use.topic = endpoints.topics()[number];
    total.use.latency_median = quantile(total, 0.5);
    total.use.latency_p99 = quantile(total, 0.99);
    total.use.share = share_of(total.use.airtime, all);
    topics.push_back(total.use);
  }
  return topics;
}

std::vector<KindUse> kinds_of(const Ledger& ledger) {
  std::map<AirKind, KindUse> totals;
  for (const AirAccount& account : ledger.accounts().all()) {
    AirKind kind = account.kind;
    kind.topic = 0;
    KindUse& use = totals[kind];
    use.kind = kind;
    use.frames += account.frames;
    use.retries += account.retries;
    use.submessages += account.submessages + account.repeated;
    use.bits += account.bits;
    use.airtime += account.airtime;
  }
  const hal::Duration all = all_airtime(ledger);
  std::vector<KindUse> kinds;
  for (auto& [kind, use] : totals) {
    use.share = share_of(use.airtime, all);
    kinds.push_back(use);
  }
  return kinds;
}

}  // namespace sim::air
