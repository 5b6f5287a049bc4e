#include "results/statistics/mser.h"

#include <vector>

#include "results/statistics/bootstrap.h"

namespace results::statistics {
namespace {

std::vector<double> batch_means(std::span<const double> series, std::size_t batch) {
  std::vector<double> means;
  for (std::size_t at = 0; at + batch <= series.size(); at += batch) {
    means.push_back(mean_of(series.subspan(at, batch)));
  }
  return means;
}

double marginal_error(std::span<const double> rest) {
  const double mean = mean_of(rest);
  double squares = 0;
  for (const double value : rest) squares += (value - mean) * (value - mean);
  const auto count = static_cast<double>(rest.size());
  return squares / (count * count);
}

}  // namespace

std::optional<WarmUp> mser(std::span<const double> series, std::size_t batch) {
  const std::vector<double> means = batch_means(series, batch);
  if (means.size() < 2) return std::nullopt;
  const std::size_t last = means.size() / 2;
  std::size_t best = 0;
  double least = marginal_error(means);
  for (std::size_t cut = 1; cut <= last; ++cut) {
    const double error = marginal_error(std::span(means).subspan(cut));
    if (error < least) {
      least = error;
      best = cut;
    }
  }
  return WarmUp{.values = best * batch, .is_too_short = best == last};
}

}  // namespace results::statistics
