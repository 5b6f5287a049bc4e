#include "sim/radio/rate/minstrel_ht.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sim::radio {
namespace {

using namespace std::chrono_literals;

/// Rates with lower success count as throughput 0, however fast they are.
constexpr double kWorthless = 0.1;
/// More success than this is taken for chance: collisions come and go.
constexpr double kBelievable = 0.9;
constexpr double kReliable = 0.75;   ///< Of such rates the fastest is the most reliable.
constexpr double kWellKnown = 0.95;  ///< Such rates need no sample.
constexpr std::uint32_t kLooks = 16;
constexpr std::uint32_t kSlowLooks = 2;
constexpr std::uint32_t kFirstLooks = 4;
constexpr std::uint32_t kLongAgo = 20;     ///< In intervals.
constexpr std::uint32_t kLeastTries = 2;   ///< Of a rate that is not worthless.
constexpr hal::Duration kStageTime = 6ms;  ///< In which the tries of a stage fit.

std::uint32_t rounded(double mpdus) { return static_cast<std::uint32_t>(std::lround(mpdus)); }

}  // namespace

MinstrelHt::Link& MinstrelHt::link(hal::AgentId to, hal::Time now) {
  const auto [entry, is_new] = links_.try_emplace(to);
  Link& one = entry->second;
  if (is_new) {
    begin(one, groups(to));
  } else if (now >= one.interval_end) {
    evaluate(one);
  } else {
    return one;
  }
  one.interval_end = now + config_.minstrel_interval;
  return one;
}

void MinstrelHt::begin(Link& link, const std::vector<Ladder>& groups) {
  for (const Ladder& ladder : groups) {
    link.groups.push_back({link.rates.size(), ladder.size(), {}});
    for (const Rung& rung : ladder) link.rates.push_back({.rung = &rung});
  }
  for (Rate& rate : link.rates) measure(link, rate);
  link.looks = kLooks;
  link.slow_looks = kSlowLooks;
  link.first_looks = kFirstLooks;
}

void MinstrelHt::evaluate(Link& link) const {
  if (link.ppdus > 0) {
    const double now = static_cast<double>(link.mpdus) / link.ppdus;
    link.mean_mpdus = config_.minstrel_past * link.mean_mpdus + (1 - config_.minstrel_past) * now;
    link.ppdus = link.mpdus = 0;
  }
  for (Rate& rate : link.rates) {
    average(rate);
    measure(link, rate);
  }
  rank(link);
  link.looks = kLooks;
  link.slow_looks = kSlowLooks;
}

void MinstrelHt::average(Rate& rate) const {
  if (rate.attempts == 0) {
    ++rate.intervals_without;
    return;
  }
  const double now = static_cast<double>(rate.successes) / rate.attempts;
  const double past = rate.is_known ? config_.minstrel_past : 0;
  rate.success = past * rate.success + (1 - past) * now;
  rate.is_known = true;
  rate.attempts = rate.successes = rate.intervals_without = 0;
}

/// Computes throughput and tries from the success.
void MinstrelHt::measure(Link& link, Rate& rate) {
  const AverageExchange exchange = average_exchange(*rate.rung, rounded(link.mean_mpdus));
  const bool is_worthless = rate.success < kWorthless;
  const double seconds = hal::to_seconds(exchange.time);
  rate.throughput =
      is_worthless ? 0 : std::min(rate.success, kBelievable) * exchange.mpdus / seconds;
  const auto fitting = static_cast<std::uint32_t>(kStageTime / exchange.time);
  const std::uint32_t most = std::max(kLeastTries, rate.rung->tries);
  rate.tries = is_worthless ? 1 : std::clamp(fitting, kLeastTries, most);
}

void MinstrelHt::rank(Link& link) {
  // If no rate works, the lowest is used; if no other than the best does, there is no second best.
  link.best = link.second = link.most_reliable = 0;
  const auto value = [&](std::size_t i) { return link.rates[i].throughput; };
  const auto reliability = [&](std::size_t i) {
    const double success = link.rates[i].success;
    return success > kReliable ? std::pair(kReliable, value(i)) : std::pair(success, 0.0);
  };
  for (std::size_t i = 0; i < link.rates.size(); ++i) {
    if (value(i) > value(link.best)) {
      link.second = link.best;
      link.best = i;
    } else if (i != link.best && value(i) > (link.second == link.best ? 0 : value(link.second))) {
      link.second = i;
    }
    if (reliability(i) > reliability(link.most_reliable)) link.most_reliable = i;
  }
}

void MinstrelHt::start_ppdu(Link& link) {
  link.failures = 0;
  link.stages = {link.best, link.second, link.most_reliable};
  link.tries = {link.rates[link.best].tries, link.rates[link.second].tries};
  if (link.wait > 0) {
    --link.wait;
  } else if (link.looks > 0 && look_around(link)) {
    --link.looks;
    if (link.first_looks > 0) --link.first_looks;
    if (link.first_looks == 0) {
      link.wait = config_.minstrel_ht_wait + 2 * rounded(link.mean_mpdus);
    }
  }
}

/// Takes the next candidate. @return whether the PPDU is a sample.
bool MinstrelHt::look_around(Link& link) {
  Group& group = link.groups[link.next_group];
  link.next_group = (link.next_group + 1) % link.groups.size();
  const std::size_t at = next_in_order(group);
  if (!is_worth_a_look(link, at)) return false;
  link.stages = {at, link.best, link.most_reliable};
  link.tries = {1, link.rates[link.best].tries};
  return true;
}

bool MinstrelHt::is_worth_a_look(Link& link, std::size_t at) {
  if (at == link.best || at == link.second || at == link.most_reliable) return false;
  const Rate& rate = link.rates[at];
  if (rate.success > kWellKnown) return false;
  const auto streams = [&](std::size_t i) { return link.rates[i].rung->mode->id().streams; };
  const auto speed = [&](std::size_t i) { return link.rates[i].rung->mode->rate().value; };
  const bool is_fast = speed(at) > speed(link.second) ||
                       (streams(at) < streams(link.best) && speed(at) > speed(link.most_reliable));
  if (is_fast) return true;
  if (rate.intervals_without < kLongAgo || link.slow_looks == 0) return false;
  --link.slow_looks;
  return true;
}

/// Visits each rate of a group once, then all again in a new random order.
std::size_t MinstrelHt::next_in_order(Group& group) {
  if (group.order.empty()) {
    for (std::size_t i = 0; i < group.size; ++i) group.order.push_back(group.first + i);
    for (std::size_t left = group.size; left > 1; --left) {
      std::swap(group.order[left - 1],
                group.order[random_.below(static_cast<std::uint32_t>(left))]);
    }
  }
  const std::size_t next = group.order.back();
  group.order.pop_back();
  return next;
}

const PhyMode& MinstrelHt::mode(hal::AgentId to, std::uint32_t attempt, hal::Time now) {
  if (groups(to).empty()) return legacy_.mode(to, attempt, now);
  Link& one = link(to, now);
  // What failed before has been given up if this is a first attempt. A PPDU whose RTS got no
  // response is still the same.
  const bool is_new = !one.is_begun || (attempt == 0 && one.failures > 0);
  if (is_new) start_ppdu(one);
  one.is_begun = true;
  std::size_t stage = 0;
  for (std::uint32_t before = 0; stage < one.tries.size(); ++stage) {
    before += one.tries[stage];
    if (one.failures < before) break;
  }
  one.used = one.stages[stage];
  return *one.rates[one.used].rung->mode;
}

const PhyMode& MinstrelHt::reliable_mode(hal::AgentId to, hal::Time now) {
  if (groups(to).empty()) return legacy_.reliable_mode(to, now);
  const Link& one = link(to, now);
  return *one.rates[one.most_reliable].rung->mode;
}

void MinstrelHt::on_result(hal::AgentId to, bool is_success) {
  const auto found = links_.find(to);
  if (found == links_.end()) return legacy_.on_result(to, is_success);
  note(found->second, is_success ? 1 : 0, 1);
}

void MinstrelHt::on_aggregate(hal::AgentId to, std::uint32_t received, std::uint32_t sent) {
  const auto found = links_.find(to);
  if (found == links_.end()) return legacy_.on_aggregate(to, received, sent);
  note(found->second, received, sent);
}

void MinstrelHt::note(Link& link, std::uint32_t received, std::uint32_t sent) const {
  Rate& rate = link.rates[link.used];
  rate.attempts += sent;
  rate.successes += received;
  ++link.ppdus;
  link.mpdus += sent;
  if (received > 0) {
    link.is_begun = false;
  } else {
    ++link.failures;
  }
}

}  // namespace sim::radio
