#include "baraka/campaign/time_left.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <queue>

namespace baraka::campaign {
namespace {

/// 97.5 % quantile of Student's t for a number of degrees of freedom (published tables). A time
/// shown in minutes needs no more digits.
double t_quantile(std::size_t degrees) {
  constexpr std::array<double, 10> kFirst = {12.706, 4.303, 3.182, 2.776, 2.571,
                                             2.447,  2.365, 2.306, 2.262, 2.228};
  if (degrees <= kFirst.size()) return kFirst.at(degrees - 1);
  return 1.96 + 2.6 / static_cast<double>(degrees);
}

}  // namespace

void TimeLeftEstimate::add_to(Sums& sums, double value) {
  ++sums.count;
  const double off = value - sums.mean;
  sums.mean += off / static_cast<double>(sums.count);
  sums.squares += off * (value - sums.mean);
}

void TimeLeftEstimate::add(int point, double wall_s) {
  add_to(points_[point], wall_s);
  add_to(all_, wall_s);
}

double TimeLeftEstimate::mean_of(int point) const {
  const auto found = points_.find(point);
  return found == points_.end() ? all_.mean : found->second.mean;
}

std::optional<TimeLeft> TimeLeftEstimate::left(const std::vector<Running>& running,
                                               const std::vector<int>& waiting,
                                               std::size_t slots) const {
  if (all_.count == 0) return std::nullopt;
  // The time at which each slot becomes free: the next run starts in the earliest.
  std::priority_queue<double, std::vector<double>, std::greater<>> free;
  double last = 0;
  for (const Running& run : running) {
    free.push(std::max(0.0, mean_of(run.point) - run.for_s));
    last = std::max(last, mean_of(run.point) - run.for_s);
  }
  while (free.size() < slots) free.push(0);
  for (const int point : waiting) {
    const double end = free.top() + mean_of(point);
    free.pop();
    free.push(end);
    last = std::max(last, end);
  }
  TimeLeft left{.seconds = last, .low = {}, .high = {}};
  double squares = 0;
  for (const auto& [point, sums] : points_) squares += sums.squares;
  const bool by_point = all_.count > points_.size();
  if (!by_point && all_.count < 2) return left;
  const std::size_t degrees = by_point ? all_.count - points_.size() : all_.count - 1;
  const double variance = (by_point ? squares : all_.squares) / static_cast<double>(degrees);
  const auto coming = static_cast<double>(running.size() + waiting.size());
  const auto seen = static_cast<double>(all_.count);
  const double sd = std::sqrt(variance * coming * (1 + coming / seen));
  const double margin = t_quantile(degrees) * sd / static_cast<double>(slots);
  left.low = std::max(0.0, last - margin);
  left.high = last + margin;
  return left;
}

}  // namespace baraka::campaign
