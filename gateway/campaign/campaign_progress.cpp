#include "gateway/campaign/campaign_progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "hal/types/printable.h"

namespace gateway {
namespace {

using namespace std::chrono_literals;
using sim::campaign::RunPlan;
using sim::campaign::RunRow;
using sim::campaign::RunState;

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
  running_[run.run] = {run.point, now};
  if (!waiting_.empty()) waiting_.pop_back();
}

void CampaignProgress::on_end(const RunRow& row, const std::string& name, Clock::time_point now) {
  const auto found = running_.find(row.plan.run);
  const double took = found == running_.end() ? 0 : seconds_of(now - found->second.second);
  if (found != running_.end()) running_.erase(found);
  ++ended_;
  const bool failed = row.state == RunState::kFailed;
  if (failed) ++failed_;
  if (!failed) estimate_.add(row.plan.point, row.wall_s.value_or(took));
  if (!failed && !settings_.every_run) return;
  clear_line();
  const std::string what = failed ? "failed: " + row.error : row.result;
  fmt::print(stderr, "{} (seed {}): {}, {:.1f} s; {}\n", name, row.plan.seed, hal::printable(what),
             took, summary(now));
}

void CampaignProgress::show(Clock::time_point now) {
  const auto period = settings_.terminal ? Clock::duration(500ms) : Clock::duration(10s);
  if (!settings_.terminal && settings_.every_run) return;
  if (shown_ == Clock::time_point{} && !settings_.terminal) shown_ = now;
  if (now - shown_ < period && (line_open_ || !settings_.terminal)) return;
  shown_ = now;
  const std::string line = fmt::format("{}, {} running", summary(now), running_.size());
  if (!settings_.terminal) {
    fmt::print(stderr, "{}\n", line);
    return;
  }
  fmt::print(stderr, "\r{} {}\033[K", bar(), line);
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
  return estimate_.left(running, {waiting_.rbegin(), waiting_.rend()}, settings_.slots);
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

}  // namespace gateway
