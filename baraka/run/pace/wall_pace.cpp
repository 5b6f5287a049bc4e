#include "baraka/run/pace/wall_pace.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "baraka/run/pace/interrupts.h"
#include "hal/types/terminal_colours.h"

namespace baraka::run::pace {
namespace {

using namespace std::chrono_literals;

constexpr hal::Duration kShowOnTerminal = 500ms;
constexpr hal::Duration kShowAsLines = 10s;
constexpr double kLeastForEstimate = 5;  // s of wall time

/// "12 s", "3 min", "2.5 h": rounded, because it is an estimate. @param seconds  of wall time.
std::string words(double seconds) {
  constexpr double kMinute = 60, kHour = 3600;
  if (seconds < 2 * kMinute) return fmt::format("{:.0f} s", seconds);
  if (seconds < 2 * kHour) return fmt::format("{:.0f} min", seconds / kMinute);
  return fmt::format("{:.1f} h", seconds / kHour);
}

}  // namespace

void WallPace::end() {
  if (started_) last_ = clock_.now();
  if (std::exchange(line_open_, false)) fmt::print(stderr, "\n");
}

WallPace::Verdict WallPace::may_go_on(hal::Time next, const sim::agents::Progress& progress) {
  last_ = clock_.now();
  if (!started_) {
    start_ = shown_ = saved_ = last_;
    started_ = true;
  }
  const bool waited = throttle(next) || hold(next);
  if (last_ - shown_ >= (settings_.terminal ? kShowOnTerminal : kShowAsLines)) show(progress);
  if (last_ - saved_ >= 1s) {
    settings_.once_a_second();
    saved_ = last_;
  }
  if (interrupted()) return Verdict::kBreakOff;
  return waited ? Verdict::kAskAgain : Verdict::kGoOn;
}

bool WallPace::is_broken_off() {
  const hal::Time now = clock_.now();
  if (started_ && now - saved_ >= 1s) {
    settings_.once_a_second();
    saved_ = now;
  }
  return interrupted();
}

bool WallPace::throttle(hal::Time next) {
  constexpr double kWorthSleeping = 1e-3, kSlice = 50e-3;  // s
  const double left = hal::to_seconds(next) / settings_.max_speed - wall_seconds();
  if (left < kWorthSleeping) return false;
  clock_.wait({}, hal::from_seconds(std::min(left, kSlice)));
  last_ = clock_.now();
  return true;
}

bool WallPace::hold(hal::Time next) {
  if (!settings_.hold) return false;
  const auto wait = settings_.hold(next);
  if (!wait) return false;
  clock_.wait({}, *wait);
  last_ = clock_.now();
  return true;
}

std::string WallPace::simulated(hal::Time now) const {
  const double seconds = hal::to_seconds(now);
  if (!settings_.end) return fmt::format("{:9.1f} s simulated", seconds);
  const double end = hal::to_seconds(*settings_.end);
  std::string line =
      fmt::format("{:9.1f} of {}{:.1f} s simulated ({:.0f} %)", seconds,
                  settings_.may_end_earlier ? "at most " : "", end, 100 * seconds / end);
  // Extrapolates the mean speed so far; no estimate in the first seconds.
  const double wall = wall_seconds();
  if (wall < kLeastForEstimate || seconds <= 0) return line;
  return line + fmt::format(", {}{} left", settings_.may_end_earlier ? "at most " : "",
                            words((end - seconds) * wall / seconds));
}

void WallPace::show(const sim::agents::Progress& progress) {
  const double wall = hal::to_seconds(last_ - shown_);
  const double factor = hal::to_seconds(progress.now - shown_time_) / wall;
  const std::string line =
      fmt::format("{}, {:.4g} x real time, {} events, {} exchanges, {} controller process{}",
                  simulated(progress.now), factor, progress.events, progress.exchanges,
                  settings_.processes, settings_.processes == 1 ? "" : "es");
  fmt::print(stderr, fmt::runtime(settings_.terminal ? "\r{}\033[K" : "{}\n"),
             hal::coloured_for(stderr, hal::Tone::kProgress, line));
  std::fflush(stderr);
  line_open_ = settings_.terminal;
  shown_ = last_;
  shown_time_ = progress.now;
}

}  // namespace baraka::run::pace
