#include "sim/radio/minstrel.h"

#include <algorithm>

namespace sim::radio {
namespace {

/// Rates that fail so often count for nothing, however fast they are.
constexpr double kHopeless = 0.1;
/// More is not told apart: a rate that has not failed yet is no better than one that seldom does.
constexpr double kSure = 0.95;

/// Frames in time, in units that do not matter.
double throughput(double success, const Rung& rung) {
  if (success < kHopeless) return 0;
  return std::min(success, kSure) / hal::to_seconds(rung.cost);
}

}  // namespace

Minstrel::Link& Minstrel::link(hal::AgentId to, hal::Time now) {
  const auto [entry, is_new] = links_.try_emplace(to);
  Link& one = entry->second;
  if (is_new) {
    one.rates.resize(ladder(to).size());
    one.interval_end = now + config_.minstrel_interval;
  } else if (now >= one.interval_end) {
    evaluate(one, ladder(to));
    one.interval_end = now + config_.minstrel_interval;
  }
  return one;
}

void Minstrel::evaluate(Link& link, const Ladder& ladder) const {
  for (Rate& rate : link.rates) {
    if (rate.attempts == 0) continue;
    const double now = static_cast<double>(rate.successes) / rate.attempts;
    const double past = rate.is_known ? config_.minstrel_past : 0;
    rate = {.success = past * rate.success + (1 - past) * now, .is_known = true};
  }
  const auto value = [&](std::size_t i) { return throughput(link.rates[i].success, ladder[i]); };
  // Without any that works: the lowest.
  link.best = link.second = link.most_reliable = 0;
  for (std::size_t i = 0; i < link.rates.size(); ++i) {
    if (value(i) > value(link.best)) {
      link.second = link.best;
      link.best = i;
    } else if (i != link.best && (link.second == link.best || value(i) > value(link.second))) {
      link.second = i;
    }
    const double most = std::min(kSure, link.rates[link.most_reliable].success);
    const double success = std::min(kSure, link.rates[i].success);
    if (success > most || (success == most && value(i) > value(link.most_reliable))) {
      link.most_reliable = i;
    }
  }
}

void Minstrel::draw(Link& link) {
  link.drawn = link.best;
  if (link.rates.size() < 2 || random_.uniform() >= config_.minstrel_sampling) return;
  link.drawn = random_.below(static_cast<std::uint32_t>(link.rates.size() - 1));
  if (link.drawn >= link.best) ++link.drawn;
}

std::size_t Minstrel::choose(const Link& link, const Ladder& ladder, std::uint32_t attempt) const {
  const bool is_slow = ladder[link.drawn].cost > ladder[link.best].cost;
  if (attempt == (is_slow ? 1u : 0u)) return link.drawn;
  if (attempt < 2) return link.best;
  if (attempt < 4) return link.second;
  return attempt < 6 ? link.most_reliable : 0;
}

const PhyMode& Minstrel::mode(hal::AgentId to, std::uint32_t attempt, hal::Time now) {
  Link& one = link(to, now);
  if (attempt == 0) draw(one);
  one.used = choose(one, ladder(to), attempt);
  return *ladder(to)[one.used].mode;
}

void Minstrel::on_result(hal::AgentId to, bool is_success) {
  const auto found = links_.find(to);
  if (found == links_.end()) return;
  Rate& rate = found->second.rates[found->second.used];
  ++rate.attempts;
  rate.successes += is_success ? 1 : 0;
}

}  // namespace sim::radio
