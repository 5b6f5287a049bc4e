// How often the 95 % intervals hold the true mean: the table of docs/statistics.md, computed again.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <vector>

#include "hal/types/math.h"
#include "hal/types/random.h"
#include "sim/statistics/bootstrap.h"
#include "sim/statistics/interval.h"

namespace sim::statistics {
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

}  // namespace
}  // namespace sim::statistics
