#include "baraka/campaign/campaign_progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "hal/types/printable.h"
#include "hal/types/terminal_colours.h"

namespace baraka::campaign {
namespace {

using namespace std::chrono_literals;
using results::campaign::RunPlan;
using results::campaign::RunRow;
using results::campaign::RunState;

double seconds_of(CampaignProgress::Clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

std::string clock_like(double seconds) {
  const auto whole = std::lround(seconds);
  return whole < 100     ? fmt::format("{} s", whole)
         : whole < 36000 ? fmt::format("{} min {:02} s", whole / 60, whole % 60)
                         : fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

std::string words_of(const TimeLeft& left) {
  std::string words = fmt::format("about {} left", clock_like(left.seconds));
  if (left.low && left.high && clock_like(*left.low) != clock_like(*left.high)) {
    words += fmt::format(" ({} to {})", clock_like(*left.low), clock_like(*left.high));
  }
  return words;
}

void CampaignProgress::on_earlier(const RunRow& row) {
  if (row.state == RunState::kDone && row.wall_s) estimate_.add(row.plan.point, *row.wall_s);
}

void CampaignProgress::set_waiting(const std::vector<RunPlan>& runs) {
  waiting_.clear();
  for (auto run = runs.rbegin(); run != runs.rend(); ++run) waiting_.push_back(run->point);
  total_ = runs.size();
}

void CampaignProgress::on_start(const RunPlan& run, Clock::time_point now) {
  queued_[run.run] = run.point;
  if (!waiting_.empty()) waiting_.pop_back();
  fill_slots(now);
}

void CampaignProgress::fill_slots(Clock::time_point now) {
  while (!queued_.empty() && running_.size() < settings_.slots) {
    const auto [run, point] = *queued_.begin();
    running_[run] = {point, now};
    queued_.erase(queued_.begin());
  }
}

void CampaignProgress::on_end(const RunRow& row, const std::string& name, Clock::time_point now) {
  const auto found = running_.find(row.plan.run);
  const double took =
      row.wall_s.value_or(found == running_.end() ? 0 : seconds_of(now - found->second.second));
  if (found != running_.end()) running_.erase(found);
  queued_.erase(row.plan.run);
  fill_slots(now);
  ++ended_;
  const bool failed = row.state == RunState::kFailed;
  if (failed) ++failed_;
  if (!failed) estimate_.add(row.plan.point, took);
  if (!failed && !settings_.every_run) return;
  clear_line();
  const std::string what = failed ? "failed: " + row.error : row.result;
  fmt::print(stderr, "{} (seed {}): {}, {:.1f} s; {}\n", name, row.plan.seed, hal::printable(what),
             took, summary(now));
}

void CampaignProgress::show(Clock::time_point now, std::size_t running) {
  const auto period = settings_.terminal ? Clock::duration(500ms) : Clock::duration(10s);
  if (!settings_.terminal && settings_.every_run) return;
  if (shown_ == Clock::time_point{} && !settings_.terminal) shown_ = now;
  if (now - shown_ < period && (line_open_ || !settings_.terminal)) return;
  shown_ = now;
  const std::size_t given = running_.size() + queued_.size();
  std::string line = fmt::format("{}, {} running", summary(now), running);
  if (running < given) line += fmt::format(", {} queued", given - running);
  if (!settings_.terminal) {
    fmt::print(stderr, "{}\n", line);
    return;
  }
  fmt::print(stderr, "\r{} {}\033[K", bar(), hal::coloured_for(stderr, hal::Tone::kProgress, line));
  std::fflush(stderr);
  line_open_ = true;
}

void CampaignProgress::clear_line() {
  if (std::exchange(line_open_, false)) fmt::print(stderr, "\r\033[K");
}

void CampaignProgress::end() {
  if (std::exchange(line_open_, false)) fmt::print(stderr, "\n");
}

std::optional<TimeLeft> CampaignProgress::left(Clock::time_point now) const {
  std::vector<TimeLeftEstimate::Running> running;
  for (const auto& [run, since] : running_) {
    running.push_back({since.first, seconds_of(now - since.second)});
  }
  std::vector<int> coming;
  for (const auto& [run, point] : queued_) coming.push_back(point);
  coming.insert(coming.end(), waiting_.rbegin(), waiting_.rend());
  return estimate_.left(running, coming, settings_.slots);
}

std::string CampaignProgress::bar() const {
  constexpr std::size_t kWidth = 24;
  const std::size_t full = total_ == 0 ? kWidth : std::min(kWidth, ended_ * kWidth / total_);
  return fmt::format("[{}{}]", std::string(full, '#'), std::string(kWidth - full, '.'));
}

std::string CampaignProgress::summary(Clock::time_point now) const {
  const auto left_now = left(now);
  return fmt::format("{} of {}{}{}", ended_, total_,
                     failed_ > 0 && !settings_.every_run ? fmt::format(", {} failed", failed_) : "",
                     left_now ? ", " + words_of(*left_now) : "");
}

}  // namespace baraka::campaign
