#include "sim/radio/rate/minstrel.h"

#include <algorithm>
#include <utility>

namespace sim::radio {
namespace {

/// Rates with lower success count as throughput 0, however fast they are.
constexpr double kHopeless = 0.1;
/// Above this success, rates differ only in speed.
constexpr double kSure = 0.95;
constexpr std::uint32_t kFewTries = 2;      ///< Attempts at a rate that is hopeless or sure.
constexpr std::uint32_t kFewLooks = 4;      ///< Samples of such a rate in an interval.
constexpr std::uint32_t kLongWithout = 20;  ///< In intervals.
constexpr std::uint32_t kFramesCounted = 10'000;

/// Frames per time, in arbitrary units.
double throughput(double success, const Rung& rung) {
  return success < kHopeless ? 0 : success / hal::to_seconds(rung.airtime);
}

}  // namespace

Minstrel::Link& Minstrel::link(hal::AgentId to, hal::Time now) {
  const auto [entry, is_new] = links_.try_emplace(to);
  Link& one = entry->second;
  if (is_new) {
    begin(one, ladder(to));
  } else if (now >= one.interval_end) {
    evaluate(one, ladder(to));
  } else {
    return one;
  }
  one.interval_end = now + config_.minstrel_interval;
  return one;
}

void Minstrel::begin(Link& link, const Ladder& ladder) const {
  for (const Rung& rung : ladder) link.rates.push_back({.tries = rung.tries});
}

void Minstrel::evaluate(Link& link, const Ladder& ladder) const {
  for (std::size_t i = 0; i < link.rates.size(); ++i) {
    Rate& rate = link.rates[i];
    if (rate.attempts > 0) {
      const double now = static_cast<double>(rate.successes) / rate.attempts;
      const double past = rate.is_known ? config_.minstrel_past : 0;
      rate = {.success = past * rate.success + (1 - past) * now, .is_known = true};
    } else {
      ++rate.intervals_without;
    }
    const bool is_clear = rate.success < kHopeless || rate.success > kSure;
    rate.tries = is_clear ? std::min(kFewTries, ladder[i].tries / 2) : ladder[i].tries;
    if (rate.tries == 0) rate.tries = kFewTries;
    rate.looks = is_clear ? std::optional(kFewLooks) : std::nullopt;
  }
  rank(link, ladder);
}

void Minstrel::rank(Link& link, const Ladder& ladder) {
  const auto value = [&](std::size_t i) { return throughput(link.rates[i].success, ladder[i]); };
  // If no rate works, the lowest is used.
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

void Minstrel::start_frame(Link& link, const Ladder& ladder) {
  link.stages = {link.best, link.second, link.most_reliable, 0};
  ++link.frames;
  if (link.rates.size() > 1 && is_to_look(link)) look_around(link, ladder);
  if (link.frames >= kFramesCounted) link.frames = link.looked = 0;
}

/// Samples as often as is needed for the configured share of frames. A larger backlog, as after
/// rates that could not be sampled, is dropped, so that samples do not come in a burst.
bool Minstrel::is_to_look(Link& link) const {
  const auto planned = static_cast<std::uint32_t>(link.frames * config_.minstrel_sampling);
  if (planned <= link.looked) return false;
  const auto most = static_cast<std::uint32_t>(2 * link.rates.size());
  link.looked = std::max(link.looked, planned - std::min(planned, most));
  return true;
}

void Minstrel::look_around(Link& link, const Ladder& ladder) {
  const std::size_t at = next_in_order(link);
  Rate& rate = link.rates[at];
  const bool is_slower = ladder[at].airtime > ladder[link.best].airtime;
  if (is_slower && rate.intervals_without < kLongWithout) {
    link.stages[1] = at;
  } else {
    if (rate.looks == 0u) return;
    if (rate.looks) --*rate.looks;
    link.stages[0] = at;
    link.stages[1] = link.best;
  }
  ++link.looked;
}

/// Visits each rate once, then all again in a new random order.
std::size_t Minstrel::next_in_order(Link& link) {
  if (link.order.empty()) {
    for (std::size_t i = 0; i < link.rates.size(); ++i) link.order.push_back(i);
    for (std::size_t left = link.order.size(); left > 1; --left) {
      std::swap(link.order[left - 1], link.order[random_.below(static_cast<std::uint32_t>(left))]);
    }
  }
  const std::size_t next = link.order.back();
  link.order.pop_back();
  return next;
}

const PhyMode& Minstrel::mode(hal::AgentId to, std::uint32_t attempt, hal::Time now) {
  Link& one = link(to, now);
  // A frame whose RTS got no response is still the same frame.
  if (attempt == 0 && !std::exchange(one.is_begun, true)) start_frame(one, ladder(to));
  std::size_t stage = 0;
  for (std::uint32_t before = 0; stage + 1 < one.stages.size(); ++stage) {
    before += one.rates[one.stages[stage]].tries;
    if (attempt < before) break;
  }
  one.used = one.stages[stage];
  return *ladder(to)[one.used].mode;
}

const PhyMode& Minstrel::reliable_mode(hal::AgentId to, hal::Time now) {
  return *ladder(to)[link(to, now).most_reliable].mode;
}

void Minstrel::on_result(hal::AgentId to, bool is_success) {
  const auto found = links_.find(to);
  if (found == links_.end()) return;
  found->second.is_begun = false;
  Rate& rate = found->second.rates[found->second.used];
  ++rate.attempts;
  rate.successes += is_success ? 1 : 0;
}

}  // namespace sim::radio
