// Against R: tests/statistics/reference.R made reference.json from the same data and, for the
// bootstrap, from the same resamples.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "results/statistics/bootstrap.h"
#include "results/statistics/distributions.h"
#include "results/statistics/interval.h"
#include "results/statistics/mser.h"
#include "results/statistics/paired.h"
#include "results/statistics/quantile.h"

namespace results::statistics {
namespace {

using Numbers = std::vector<double>;

constexpr std::size_t kResamples = 199;
const char* const kSamples[] = {"skewed", "normal", "tied", "large"};

const nlohmann::json& reference() {
  static const nlohmann::json json = [] {
    std::ifstream file(TESTS_DIR "/statistics/reference.json");
    return nlohmann::json::parse(file);
  }();
  return json;
}

Numbers sample(const std::string& name) { return reference()["samples"].at(name).get<Numbers>(); }

Resamples resamples_for(std::size_t count) { return {count, kResamples, 1, "reference"}; }

/// To 1e-9 of the value, or of 1 if it is smaller.
void expect_as_in_r(const std::string& name, const Numbers& ours) {
  const auto theirs = reference()["values"].at(name).get<Numbers>();
  ASSERT_EQ(ours.size(), theirs.size()) << name;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    EXPECT_NEAR(ours[i], theirs[i], 1e-9 * std::abs(theirs[i])) << name << " " << i;
  }
}

Numbers ends(const std::optional<Interval>& interval) {
  return interval ? Numbers{interval->low, interval->high} : Numbers{};
}

TEST(Reference, MomentsAndStudentIntervalsAreThoseOfR) {
  for (const std::string name : kSamples) {
    const auto of = *moments(sample(name));
    expect_as_in_r(name + ".moments", {static_cast<double>(of.count), of.mean, of.sd});
    expect_as_in_r(name + ".t.0.9", ends(mean_interval(sample(name), 0.9)));
    expect_as_in_r(name + ".t.0.95", ends(mean_interval(sample(name))));
    expect_as_in_r(name + ".t.0.99", ends(mean_interval(sample(name), 0.99)));
  }
}

TEST(Reference, QuantilesAndTheirIntervalsAreThoseOfR) {
  for (const std::string name : kSamples) {
    for (const char* p : {"0", "0.05", "0.25", "0.5", "0.75", "0.95", "1"}) {
      expect_as_in_r(name + ".quantile." + p, {*quantile(sample(name), std::atof(p))});
    }
    for (const char* p : {"0.25", "0.5", "0.75"}) {
      const auto ours = quantile_interval(sample(name), std::atof(p));
      const std::string key = name + ".order." + p;
      ASSERT_EQ(ours.has_value(), reference()["values"].contains(key)) << key;
      if (ours) expect_as_in_r(key, {ours->interval.low, ours->interval.high, ours->coverage});
    }
  }
}

TEST(Reference, DistributionsAreThoseOfR) {
  for (const char* df : {"1", "2", "3", "4", "9", "29", "99", "999"}) {
    for (const char* p : {"0.6", "0.9", "0.975", "0.995", "0.9995"}) {
      expect_as_in_r(std::string("qt.") + p + "." + df,
                     {student_t_quantile(std::atof(p), std::atof(df))});
    }
    expect_as_in_r(std::string("pt.") + df, {student_t_cdf(-2.5, std::atof(df))});
  }
  for (const char* p : {"1e-06", "0.025", "0.5", "0.8", "0.975"}) {
    expect_as_in_r(std::string("qnorm.") + p, {normal_quantile(std::atof(p))});
  }
  expect_as_in_r("pnorm", {normal_cdf(-1.7)});
}

TEST(Reference, ResamplesAreThoseThatRWasGiven) {
  for (const std::size_t count : {12U, 50U}) {
    const std::string path = TESTS_DIR "/statistics/resamples_" + std::to_string(count) + ".csv";
    const std::string ours = resamples_for(count).csv();
    if (std::getenv("BARAKA_WRITE_RESAMPLES") != nullptr) std::ofstream(path) << ours;
    std::ifstream file(path);
    EXPECT_EQ(ours, std::string(std::istreambuf_iterator<char>(file), {}));
  }
}

TEST(Reference, BootstrapIntervalsAreThoseOfR) {
  for (const std::string name : kSamples) {
    const Numbers values = sample(name);
    const Resamples resamples = resamples_for(values.size());
    for (const auto& [what, statistic] :
         {std::pair<std::string, Statistic>{"mean", mean_of}, {"median", median_of}}) {
      const auto sorted = bootstrap(values, resamples, statistic);
      expect_as_in_r(name + ".percentile." + what, ends(percentile_interval(sorted)));
      const std::string key = name + ".bca." + what;
      if (!reference()["values"].contains(key)) continue;
      expect_as_in_r(key, ends(bca_interval(values, sorted, statistic)));
    }
  }
}

TEST(Reference, PairsAreThoseOfR) {
  const Numbers first = sample("pair_first");
  const Numbers second = sample("pair_second");
  const auto ours = *compare_pairs(first, second);
  expect_as_in_r("pairs.t", {ours.difference.mean, ours.difference.sd, ours.interval.low,
                             ours.interval.high, *ours.t, *ours.p, *ours.correlation});
  expect_as_in_r("pairs.bca", ends(bootstrap_pairs(first, second, resamples_for(12))));
}

TEST(Reference, TheWarmUpIsThatOfR) {
  for (const std::string name : {"settling", "stationary", "drifting"}) {
    const auto ours = *mser(sample(name));
    expect_as_in_r(name + ".mser",
                   {static_cast<double>(ours.values), ours.is_too_short ? 1.0 : 0.0});
  }
}

}  // namespace
}  // namespace results::statistics
