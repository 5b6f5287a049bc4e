#include "gateway/run/replication_progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "gateway/exit_status.h"
#include "hal/types/printable.h"

namespace gateway {
namespace {

using namespace std::chrono_literals;

double seconds(ReplicationProgress::Clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

std::string clock_like(double seconds) {
  const auto whole = std::lround(seconds);
  return whole < 100     ? fmt::format("{} s", whole)
         : whole < 36000 ? fmt::format("{} min {:02} s", whole / 60, whole % 60)
                         : fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

}  // namespace

void ReplicationProgress::on_start(const Replication& replication, Clock::time_point now) {
  running_[replication.number] = now;
}

void ReplicationProgress::on_end(const Replication& replication, const ReplicationEnd& end,
                                 Clock::time_point now) {
  const double took = seconds(now - running_.at(replication.number));
  running_.erase(replication.number);
  ++ended_;
  took_ += took;
  if (std::exchange(line_open_, false)) fmt::print(stderr, "\r\033[K");
  const std::string what = end.status == kRunFailed ? "failed: " + end.error : end.result;
  fmt::print(stderr, "{} (seed {}): {}, {:.1f} s; {}\n", replication.name(), replication.seed,
             hal::printable(what), took, summary(now));
}

void ReplicationProgress::show(Clock::time_point now) {
  if (!terminal_ || (line_open_ && now - shown_ < 500ms)) return;
  fmt::print(stderr, "\r{}, {} running\033[K", summary(now), running_.size());
  std::fflush(stderr);
  line_open_ = true;
  shown_ = now;
}

void ReplicationProgress::end() {
  if (std::exchange(line_open_, false)) fmt::print(stderr, "\n");
}

std::optional<double> ReplicationProgress::seconds_left(Clock::time_point now) const {
  if (ended_ == 0) return std::nullopt;
  const double mean = took_ / ended_;
  double work = mean * (total_ - ended_ - static_cast<int>(running_.size()));
  for (const auto& [number, start] : running_) work += std::max(0.0, mean - seconds(now - start));
  return work / jobs_;
}

std::string ReplicationProgress::summary(Clock::time_point now) const {
  const auto left = seconds_left(now);
  return fmt::format("{} of {}{}", ended_, total_,
                     left ? fmt::format(", about {} left", clock_like(*left)) : "");
}

}  // namespace gateway
