// How often the 95 % intervals hold the true mean: the table of docs/statistics.md, computed again.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <span>
#include <vector>

#include "hal/types/math.h"
#include "hal/types/random.h"
#include "results/statistics/bootstrap.h"
#include "results/statistics/clustered_quantile.h"
#include "results/statistics/interval.h"
#include "results/statistics/quantile.h"

namespace results::statistics {
namespace {

constexpr int kExperiments = 1000;
constexpr std::size_t kBootstraps = 499;

/// Percent of the experiments whose interval held the true mean.
struct Coverage {
  double student = 0, percentile = 0, bca = 0;
};

bool holds(const Interval& interval, double mean) {
  return interval.low <= mean && mean <= interval.high;
}

/// @param draw  a value whose mean is 1.
template <class Draw>
Coverage coverage(std::size_t count, const std::string& name, Draw draw) {
  hal::RandomStream random(1, fmt::format("coverage/{}/{}", name, count));
  Coverage of;
  std::vector<double> values(count);
  for (int i = 0; i < kExperiments; ++i) {
    for (double& value : values) value = draw(random);
    of.student += holds(*mean_interval(values), 1);
    const auto sorted =
        bootstrap(values, Resamples(count, kBootstraps, random.next(), "coverage"), mean_of);
    const Interval percentile = percentile_interval(sorted);
    of.percentile += holds(percentile, 1);
    of.bca += holds(bca_interval(values, sorted, mean_of).value_or(percentile), 1);
  }
  const double percent = 100.0 / kExperiments;
  return {of.student * percent, of.percentile * percent, of.bca * percent};
}

double normal_value(hal::RandomStream& random) { return 1 + random.normal(); }
double skewed_value(hal::RandomStream& random) { return -hal::math::log(1 - random.uniform()); }

std::string row(const std::string& of, std::size_t count, const Coverage& c) {
  return fmt::format("| {} | {} | {:.1f} | {:.1f} | {:.1f} |\n", of, count, c.student, c.percentile,
                     c.bca);
}

// 1000 experiments: two standard deviations of the count are 1.4 % around 95 %.
TEST(Coverage, OfTheIntervalsIsAsTheDocumentSays) {
  std::string table;
  for (const std::size_t count : {5U, 10U, 20U, 50U}) {
    const Coverage of = coverage(count, "normal", normal_value);
    EXPECT_GE(of.student, 93) << count;
    EXPECT_LE(of.student, 97) << count;
    if (count >= 50) {
      for (const double bootstrapped : {of.percentile, of.bca}) {
        EXPECT_GE(bootstrapped, 93);
        EXPECT_LE(bootstrapped, 97);
      }
    }
    table += row("normal", count, of);
  }
  for (const std::size_t count : {5U, 10U, 20U, 50U}) {
    table += row("exponential", count, coverage(count, "exponential", skewed_value));
  }
  std::ifstream file(TESTS_DIR "/../docs/statistics.md");
  const std::string document(std::istreambuf_iterator<char>(file), {});
  EXPECT_NE(document.find(table), std::string::npos) << "docs/statistics.md should have\n" << table;
}

/// Of quantities that cannot be everything: percent that hold the mean, and that leave the range.
struct BoundedCoverage {
  double student = 0, outside = 0, score = 0, bca = 0;
};

int poisson(hal::RandomStream& random, double mean) {
  const double least = hal::math::exp(-mean);
  int count = 0;
  for (double product = random.uniform(); product > least; product *= random.uniform()) ++count;
  return count;
}

/// @param trials  of each value, of a share; 0: none.
template <class Draw>
BoundedCoverage bounded_coverage(std::size_t count, const Support& support, double mean,
                                 const std::string& name, Draw draw) {
  hal::RandomStream random(1, fmt::format("coverage/{}/{}", name, count));
  BoundedCoverage of;
  std::vector<double> values(count);
  for (int i = 0; i < kExperiments; ++i) {
    for (double& value : values) value = draw(random);
    const Interval student = *mean_interval(values);
    const Interval score = *mean_interval(values, support);
    const bool is_share = support.kind == Support::Kind::kShare;
    of.student += holds(student, mean);
    of.outside += student.low < 0 || (is_share && student.high > 1);
    of.score += holds(score, mean);
    EXPECT_GE(score.low, 0);
    if (is_share) {
      EXPECT_LE(score.high, 1);
    }
    const auto sorted =
        bootstrap(values, Resamples(count, kBootstraps, random.next(), "coverage"), mean_of);
    of.bca +=
        holds(bca_interval(values, sorted, mean_of).value_or(percentile_interval(sorted)), mean);
  }
  const double percent = 100.0 / kExperiments;
  return {of.student * percent, of.outside * percent, of.score * percent, of.bca * percent};
}

constexpr int kTrials = 200;

/// Of 200 trials.
double share_of(hal::RandomStream& random, double p) {
  int successes = 0;
  for (int i = 0; i < kTrials; ++i) successes += random.uniform() < p ? 1 : 0;
  return static_cast<double>(successes) / kTrials;
}

/// The runs differ in their mean as the square of a normal value: gamma with shape 1/2.
double spread_count(hal::RandomStream& random) {
  const double normal = random.normal();
  return poisson(random, 1.2 * normal * normal);
}

/// Each run loses 1 % of its trials, times an exponential value of its own.
double spread_share(hal::RandomStream& random) {
  return share_of(random, 1 - 0.01 * skewed_value(random));
}

TEST(Coverage, OfCountsAndSharesIsAsTheDocumentSays) {
  const Support counts{Support::Kind::kCount, {}};
  std::string table;
  const auto add = [&](const std::string& name, double mean, Support support, auto draw) {
    for (const std::size_t count : {5U, 10U, 20U}) {
      if (support.kind == Support::Kind::kShare) {
        support.trials = static_cast<double>(count * kTrials);
      }
      const BoundedCoverage of = bounded_coverage(count, support, mean, name, draw);
      EXPECT_GE(of.score, 90) << name << " " << count;
      EXPECT_GE(of.score, of.student - 1.4) << name << " " << count;
      table += fmt::format("| {} | {} | {:.1f} | {:.1f} | {:.1f} | {:.1f} |\n", name, count,
                           of.student, of.outside, of.score, of.bca);
    }
  };
  const Support shares{Support::Kind::kShare, {}};
  add("counts of mean 0.3, Poisson", 0.3, counts, [](auto& r) { return poisson(r, 0.3); });
  add("counts of mean 1.2, Poisson", 1.2, counts, [](auto& r) { return poisson(r, 1.2); });
  add("counts of mean 1.2, runs differ", 1.2, counts, spread_count);
  add("times, exponential", 1, {Support::Kind::kNotNegative, {}}, skewed_value);
  add("shares of 200 trials, 99 %", 0.99, shares, [](auto& r) { return share_of(r, 0.99); });
  add("shares of 200 trials, 99 %, runs differ", 0.99, shares, spread_share);
  add("shares of 200 trials, 50 %", 0.5, shares, [](auto& r) { return share_of(r, 0.5); });
  std::ifstream file(TESTS_DIR "/../docs/statistics.md");
  const std::string document(std::istreambuf_iterator<char>(file), {});
  EXPECT_NE(document.find(table), std::string::npos) << "docs/statistics.md should have\n" << table;
}

/// A run in which a share of the values, its own, comes 10 later.
std::vector<double> values_of_run(hal::RandomStream& random) {
  const double share = 0.6 * random.uniform();
  std::vector<double> values(200);
  for (double& value : values) {
    value = skewed_value(random) + (random.uniform() < share ? 10 : 0);
  }
  std::sort(values.begin(), values.end());
  return values;
}

/// The quantile of such values of infinitely many runs: of one exponential and one that begins at
/// 10, weighted 7 to 3, by bisection.
double true_quantile(double p) {
  const auto below = [](double x) { return x <= 0 ? 0 : 1 - hal::math::exp(-x); };
  double low = 0;
  double high = 100;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (0.7 * below(middle) + 0.3 * below(middle - 10) < p ? low : high) = middle;
  }
  return low;
}

TEST(Coverage, OfQuantilesOfRunsTogetherIsAsTheDocumentSays) {
  std::string table;
  for (const double p : {0.5, 0.95}) {
    const double truth = true_quantile(p);
    for (const std::size_t count : {5U, 10U, 20U}) {
      hal::RandomStream random(1, fmt::format("coverage/quantile/{}/{}", p, count));
      int together = 0;
      int mean = 0;
      for (int i = 0; i < kExperiments; ++i) {
        std::vector<std::vector<double>> runs;
        std::vector<double> quantiles;
        for (std::size_t run = 0; run < count; ++run) {
          runs.push_back(values_of_run(random));
          quantiles.push_back(quantile_of_sorted(runs.back(), p));
        }
        const std::vector<std::span<const double>> clusters(runs.begin(), runs.end());
        together += holds(*clustered_quantile(clusters, p)->interval, truth);
        mean += holds(*mean_interval(quantiles), truth);
      }
      EXPECT_GE(together, 920) << p << " " << count;
      table += fmt::format("| {} % | {} | {:.1f} | {:.1f} |\n", 100 * p, count, together / 10.0,
                           mean / 10.0);
    }
  }
  std::ifstream file(TESTS_DIR "/../docs/statistics.md");
  const std::string document(std::istreambuf_iterator<char>(file), {});
  EXPECT_NE(document.find(table), std::string::npos) << "docs/statistics.md should have\n" << table;
}

}  // namespace
}  // namespace results::statistics
