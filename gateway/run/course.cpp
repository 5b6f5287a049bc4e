#include "gateway/run/course.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string_view>

#include "gateway/exit_status.h"
#include "gateway/run/real_time_clock.h"
#include "hal/config/value.h"
#include "sim/scenario/resolved.h"

namespace gateway {
namespace {

constexpr double kLeastFactor = 1e-3, kMostFactor = 1e5;

/// @return none: in lock-step.
std::optional<double> real_time_factor(const std::string& pace) {
  if (pace == "lockstep") return std::nullopt;
  if (pace == "realtime") return 1;
  constexpr std::string_view kPrefix = "realtime:";
  const std::string_view text = pace;
  const auto factor = hal::config::parse_value(text.substr(std::min(kPrefix.size(), text.size())),
                                               "1", kLeastFactor, kMostFactor);
  if (!text.starts_with(kPrefix) || !factor) {
    throw UsageError(fmt::format(
        "--pace: '{}' is not one of lockstep, realtime, realtime:F with F from {} to {}", pace,
        kLeastFactor, kMostFactor));
  }
  return *factor;
}

void check_same(const std::filesystem::path& folder, const sim::scenario::Scenario& scenario) {
  const auto file = folder / "scenario.resolved.yaml";
  std::ifstream resolved(file);
  const std::string text{std::istreambuf_iterator<char>(resolved), {}};
  if (text == sim::scenario::resolved_yaml(scenario)) return;
  throw UsageError(fmt::format("--repeat: {} is not of this scenario with these settings: see {}",
                               folder.string(), file.string()));
}

}  // namespace

Course::Course(const RunOptions& options, const sim::scenario::Scenario& scenario)
    : factor_(real_time_factor(options.pace)) {
  if (options.until) until_ = hal::Time{hal::from_seconds(*options.until)};
  if (options.repeat.empty()) return;
  check_same(options.repeat, scenario);
  record_ = sim::record::read_course(options.repeat);
  until_ = std::min(until_.value_or(record_->ended_at), record_->ended_at);
}

sim::agents::Outcome Course::play(sim::agents::Simulation& simulation, WallPace& pace) const {
  if (record_) {
    simulation.outside().replay(record_->arrivals);
    if (record_->in_real_time) return simulation.repeat(until_, record_->turns, pace);
    return simulation.run(until_, pace);
  }
  if (!factor_) return simulation.run(until_, pace);
  RealTimeClock clock(*factor_, pace);
  return simulation.follow(until_, clock);
}

}  // namespace gateway
