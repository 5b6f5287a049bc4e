#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "hal/files/config/document.h"
#include "hal/files/config/errors.h"
#include "hal/types/random.h"
#include "results/coverage/mean_power.h"
#include "results/coverage/survey_fit.h"
#include "sim/scenario/radio_section.h"
#include "tests/unit/results/coverage/floor.h"

namespace tests {
namespace {

namespace fs = std::filesystem;
using namespace results::coverage;
using sim::radio::MultiWallConfig;

const MultiWallConfig kTruth{.constant_loss = hal::Decibels{4},
                             .exponent = 2.3,
                             .walls = {{"brick", hal::Decibels{5.5}},
                                       {"concrete", hal::Decibels{13}},
                                       {"wood", hal::Decibels{2.5}}}};

std::string file_of(const std::string& text) {
  const auto file = fs::path(testing::TempDir()) / ("survey" + std::to_string(::getpid()) + ".csv");
  std::ofstream(file) << text;
  return file.string();
}

/// Rows anywhere on the floor, with the mean powers of a law and normal errors.
std::vector<SurveyRow> survey(const sim::agents::SimulationConfig& config, std::size_t rows,
                              double sigma, hal::RandomStream& random) {
  const MeanPower power(config);
  std::vector<SurveyRow> all;
  for (std::size_t i = 0; i < rows; ++i) {
    const auto& ap = config.agents[i % config.agents.size()];
    SurveyRow row{.x = 20 * random.uniform(), .y = 12 * random.uniform(), .access_point = ap.name};
    const auto level = power.received(power.emission_of(ap), {row.x, row.y, 1});
    row.dbm = level.value + sigma * random.normal();
    all.push_back(row);
  }
  return all;
}

double value_of(const SurveyFit& fit, const std::string& name) {
  for (const auto& one : fit.fit.coefficients)
    if (one.name == name) return one.value;
  ADD_FAILURE() << name;
  return 0;
}

const std::map<std::string, double> kTrue{
    {"constant_loss", 4}, {"exponent", 2.3}, {"brick", 5.5}, {"concrete", 13}, {"wood", 2.5}};

TEST(Survey, WithoutErrorsGivesTheLawBack) {
  hal::RandomStream random(1, "survey");
  const auto config = floor_with(kTruth);
  const SurveyFit fit = fit_survey(config, survey(config, 60, 0, random));
  ASSERT_EQ(fit.fit.coefficients.size(), kTrue.size()) << "no ceiling is crossed";
  for (const auto& [name, value] : kTrue) EXPECT_NEAR(value_of(fit, name), value, 1e-8) << name;
  EXPECT_LT(fit.fit.sd, 1e-8);
  ASSERT_TRUE(fit.held_out);
  EXPECT_LT(fit.held_out->held, 1e-8);
}

// 95 % of exact intervals hold: 950 of 1000, with a standard deviation of 6.9.
TEST(Survey, IntervalsHoldAsOftenAsTheySay) {
  hal::RandomStream random(20, "survey");
  const auto config = floor_with(kTruth);
  std::map<std::string, int> held;
  double inside = 0, outside = 0;
  constexpr int kSurveys = 1000;
  for (int i = 0; i < kSurveys; ++i) {
    const SurveyFit fit = fit_survey(config, survey(config, 80, 4, random));
    for (const auto& one : fit.fit.coefficients) {
      const double truth = kTrue.at(one.name);
      if (one.interval.low <= truth && truth <= one.interval.high) ++held[one.name];
    }
    ASSERT_TRUE(fit.held_out);
    inside += fit.held_out->fitted / kSurveys;
    outside += fit.held_out->held / kSurveys;
  }
  for (const auto& [name, value] : kTrue) {
    EXPECT_GE(held[name], 930) << name;
    EXPECT_LE(held[name], 970) << name;
    RecordProperty(name, held[name]);
  }
  // dB: with 40 rows and 5 parameters sqrt(35 / 40) of 4 dB within, and more outside.
  EXPECT_NEAR(inside, 4 * std::sqrt(35.0 / 40), 0.05);
  EXPECT_GT(outside, 4.1);
  EXPECT_LT(outside, 4.6);
}

TEST(Survey, FitsTheCeiling) {
  hal::RandomStream random(3, "survey");
  MultiWallConfig truth = kTruth;
  truth.ceiling_loss = hal::Decibels{15};
  auto config = floor_with(truth);
  config.ceilings = {{hal::Metres{3}}};
  config.agents[1].radio.antenna_height = hal::Metres{5};  // upstairs
  const SurveyFit fit = fit_survey(config, survey(config, 100, 0, random));
  EXPECT_NEAR(value_of(fit, "ceiling_loss"), 15, 1e-8);
  EXPECT_NEAR(fit.law.ceiling_loss->value, 15, 1e-8);
}

std::string error_of(const sim::agents::SimulationConfig& config,
                     const std::vector<SurveyRow>& rows) {
  try {
    fit_survey(config, rows);
  } catch (const std::exception& e) {
    return e.what();
  }
  return "none";
}

TEST(Survey, NamesParametersThatItCannotTellApart) {
  hal::RandomStream random(4, "survey");
  auto config = floor_with(kTruth);
  // Each path that crosses the one crosses the other.
  config.walls = {
      {.name = "a", .centre = {10, 6, 1.5}, .size = {0.2, 40, 3}, .material = "brick"},
      {.name = "b", .centre = {10.2, 6, 1.5}, .size = {0.2, 40, 3}, .material = "wood"}};
  auto rows = survey(config, 60, 1, random);
  std::erase_if(rows, [](const SurveyRow& row) { return std::abs(row.x - 10.1) < 0.3; });
  EXPECT_EQ(error_of(config, rows),
            "the survey does not tell these parameters apart: brick, wood; measure where their "
            "walls are crossed in other numbers or at other distances");
  rows.resize(4);
  EXPECT_TRUE(error_of(config, rows).starts_with("4 rows are too few for 4 parameters: "));
}

TEST(Survey, OfOneDistanceDoesNotGiveTheExponent) {
  auto config = floor_with(kTruth);
  config.walls.clear();
  std::vector<SurveyRow> rows;
  for (int i = 0; i < 20; ++i) {
    rows.push_back({.x = 1 + 5 * std::cos(i),
                    .y = 1 + 5 * std::sin(i),
                    .z = 2.5,
                    .access_point = "ap0",
                    .dbm = -50.0 - i});
  }
  EXPECT_TRUE(error_of(config, rows)
                  .starts_with(
                      "the survey does not tell these parameters apart: constant_loss, exponent;"));
}

TEST(Survey, WritesARadioFileThatHasTheLaw) {
  hal::RandomStream random(5, "survey");
  const auto config = floor_with(kTruth);
  const SurveyFit fit = fit_survey(config, survey(config, 200, 3, random));
  const std::string text = survey_radio(config, fit, "What it is.");
  EXPECT_TRUE(text.starts_with("# What it is.\n#   parameter "));
  auto document = hal::files::config::Document::load(file_of(text));
  const auto radio = sim::scenario::read_radio(document.root());
  document.finish();
  const auto& law = std::get<MultiWallConfig>(waves_of(radio)->propagation.chain.at(0));
  EXPECT_DOUBLE_EQ(law.exponent, value_of(fit, "exponent"));
  EXPECT_DOUBLE_EQ(law.constant_loss.value, value_of(fit, "constant_loss"));
  ASSERT_EQ(law.walls.size(), 3u);
  for (const auto& wall : law.walls)
    EXPECT_DOUBLE_EQ(wall.loss.value, value_of(fit, wall.material));
}

TEST(Survey, WritesNoNegativeLoss) {
  hal::RandomStream random(6, "survey");
  MultiWallConfig truth = kTruth;
  truth.walls[2].loss = hal::Decibels{0};
  const auto config = floor_with(truth);
  auto rows = survey(config, 200, 0, random);
  const auto data = observations_of(config, rows);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].dbm += data.rows[i].back();  // wood gains
  const SurveyFit fit = fit_survey(config, rows);
  EXPECT_NEAR(value_of(fit, "wood"), -1, 1e-8);
  EXPECT_EQ(fit.law.walls.back().loss.value, 0);
  ASSERT_EQ(fit.warnings.size(), 1u);
  EXPECT_EQ(fit.warnings[0], "wood: the fit gives -1.00 dB; 0 dB is written");
}

std::vector<std::string> mistakes_in(const std::string& text) {
  const std::string file = file_of(text);
  std::vector<std::string> mistakes;
  try {
    read_survey(file);
  } catch (const hal::files::config::ConfigErrors& e) {
    for (const std::string& one : e.messages()) mistakes.push_back(one.substr(file.size() + 1));
  }
  return mistakes;
}

using Mistakes = std::vector<std::string>;

TEST(Survey, ReadsColumnsInAnyOrder) {
  const auto rows = read_survey(
      file_of("# made by hand\nAccess Point, dBm, x, note, y, Z\nap0, -41.5, 1, a, 2, 1.5\n"));
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].access_point, "ap0");
  EXPECT_EQ(rows[0].dbm, -41.5);
  EXPECT_EQ(rows[0].x, 1);
  EXPECT_EQ(rows[0].y, 2);
  EXPECT_EQ(rows[0].z, 1.5);
}

TEST(Survey, SaysWhereAFileIsWrong) {
  EXPECT_EQ(mistakes_in("x,y,access_point,dbm\n1,2,ap0,-40\n1, two,ap0,9e9\n1,2,ap0\n"),
            (Mistakes{"3:4: y: 'two' is not a number from -1e+06 to 1e+06",
                      "3:12: dbm: '9e9' is not a number from -200 to 50",
                      "4:1: has 3 values, the header 4"}));
  EXPECT_EQ(mistakes_in("x,y,ap0,-40\n"),
            (Mistakes{"1:1: the header has no column 'access_point'; needed are x, y, access_point "
                      "and dbm, and z if heights were measured",
                      "1:1: the header has no column 'dbm'; needed are x, y, access_point and dbm, "
                      "and z if heights were measured"}));
  EXPECT_EQ(mistakes_in("x,y,x,access_point,dbm\n"), (Mistakes{"1:5: column 'x' twice"}));
  EXPECT_EQ(mistakes_in("x,y,access_point,dbm\n"), (Mistakes{"1:1: has no rows"}));
}

TEST(Survey, SaysWhichRowNamesNoAgent) {
  const std::string file = file_of("x,y,access_point,dbm\n1,2,ap0,-40\n1,2,ap7,-40\n");
  EXPECT_EQ(error_of(floor_with(kTruth), read_survey(file)),
            file + ":3:5: access_point: the scenario has no agent 'ap7'; it has ap0, ap1");
}

}  // namespace
}  // namespace tests
