#include "baraka/run/check/program_pace.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "gateway/process/exit_status.h"
#include "hal/files/config/value.h"

namespace baraka::run::check {
namespace {

constexpr double kLeastFactor = 1e-3, kMostFactor = 1e5;
constexpr double kLeastFactorOfPrograms = 0.01;

}  // namespace

std::optional<double> real_time_factor(const std::string& pace) {
  if (pace == "lockstep") return std::nullopt;
  if (pace == "realtime") return 1;
  constexpr std::string_view kPrefix = "realtime:";
  const std::string_view text = pace;
  const auto factor = hal::files::config::parse_value(
      text.substr(std::min(kPrefix.size(), text.size())), "1", kLeastFactor, kMostFactor);
  if (!text.starts_with(kPrefix) || !factor) {
    throw gateway::process::UsageError(fmt::format(
        "--pace: '{}' is not one of lockstep, realtime, realtime:F with F from {} to {}", pace,
        kLeastFactor, kMostFactor));
  }
  return *factor;
}

void require_pace_for_programs(const std::string& pace) {
  const std::optional<double> factor = real_time_factor(pace);
  if (!factor || (*factor >= kLeastFactorOfPrograms && *factor <= 1)) return;
  throw gateway::process::UsageError(fmt::format(
      "--pace: realtime:{}: with agents that have a network, F must be from {} to 1: their "
      "programs can be slowed, not hastened",
      *factor, kLeastFactorOfPrograms));
}

programs::netns::ProgramTime program_time(const std::string& pace) {
  const std::optional<double> factor = real_time_factor(pace);
  return {.is_held = !factor, .factor = factor.value_or(1)};
}

}  // namespace baraka::run::check
