#include "sim/radio/rate/ideal.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "hal/types/math.h"

namespace sim::radio {
namespace {

constexpr std::uint32_t kUntilForgotten = 7;
constexpr double kLowestDb = -20, kHighestDb = 60;
constexpr int kHalvings = 30;

/// A-MPDUs make preambles and whole symbols count for little.
double time_of(const Rung& rung) {
  if (!has_streams(rung.mode->modulation_class())) return hal::to_seconds(rung.airtime);
  return rung.bits / rung.mode->rate().value;
}

double ratio_of(double db) { return hal::math::pow(10, db / 10); }

}  // namespace

Ideal::Link& Ideal::link(hal::AgentId to) {
  const auto [entry, is_new] = links_.try_emplace(to);
  if (is_new) entry->second.steps = steps_to(to);
  return entry->second;
}

std::vector<Ideal::Step> Ideal::steps_to(hal::AgentId to) const {
  Ladder all;
  for (const Ladder& group : groups(to)) std::ranges::copy(group, std::back_inserter(all));
  if (all.empty()) all = ladder(to);
  std::vector<Step> steps;
  for (const Rung& rung : all) steps.push_back({rung.mode, time_of(rung), needed_by(rung)});
  std::ranges::stable_sort(steps, {}, [](const Step& step) {
    return std::pair(step.time, step.needed * step.mode->width());
  });
  return steps;
}

/// Bisection: success grows with the SINR.
double Ideal::needed_by(const Rung& rung) const {
  double low = kLowestDb, high = kHighestDb;
  const double bits = rung.mode->bits_at_risk(rung.bits);
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (low + high) / 2;
    const bool is_enough = rung.mode->success(ratio_of(middle), bits) >= 1 - config_.ideal_loss;
    (is_enough ? high : low) = middle;
  }
  return ratio_of(high);
}

const PhyMode& Ideal::mode(hal::AgentId to, std::uint32_t, hal::Time) {
  const Link& one = link(to);
  const auto found = std::ranges::find_if(one.steps, [&](const Step& step) {
    return one.snr_per_width >= step.needed * step.mode->width();
  });
  return *(found == one.steps.end() ? one.steps.back() : *found).mode;
}

void Ideal::on_answer(hal::AgentId to, hal::Decibels snr, std::uint16_t width) {
  link(to).snr_per_width = ratio_of(snr.value) * width;
}

void Ideal::on_result(hal::AgentId to, bool is_success) {
  Link& one = link(to);
  one.failures = is_success ? 0 : one.failures + 1;
  if (one.failures < kUntilForgotten) return;
  one.failures = 0;
  one.snr_per_width = -1;
}

}  // namespace sim::radio
