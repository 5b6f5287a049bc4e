#include "results/report/plot.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "results/report/axis.h"
#include "results/report/experiment_section.h"
#include "results/report/svg.h"

namespace results::report::test {
namespace {

/// Speeds 1 and 2 m/s, radios a and b, five seeds each: the quantity x is 10 speed + (b: 100) + 0,
/// 1, 2, 3, 4 by seed.
Experiment two_by_two() {
  Experiment experiment;
  experiment.factors = {{"agents.r.speed", "m/s"}, {"radio.profile", ""}};
  experiment.units = {{"x", "s"}};
  for (const double speed : {1.0, 2.0}) {
    for (const char* radio : {"a", "b"}) {
      Experiment::Point& point = experiment.points.emplace_back();
      point.levels = {{fmt::format("{} m/s", speed), speed}, {radio, std::nullopt}};
      for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const std::size_t run = experiment.runs.size();
        point.runs.push_back(run);
        experiment.runs.push_back({"run", experiment.points.size() - 1, seed});
        experiment.values[{"x", ""}][run] =
            10 * speed + (*radio == 'b' ? 100 : 0) + static_cast<double>(seed - 1);
      }
    }
  }
  return experiment;
}

std::size_t count_of(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; ++at) ++count;
  return count;
}

std::string message_of(const Experiment& experiment, const sim::scenario::PlotRequest& request) {
  try {
    make_plot(experiment, request);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "no error";
}

// 0 .. 4: mean 2, sd sqrt(2.5), t(0.975, 4) = 2.776445.
TEST(PlotTest, PointsAreMeansOverTheRunsOfOneSettingWithStudentsInterval) {
  const Plot plot = make_plot(two_by_two(), {.plot = "x", .versus = "speed"});
  ASSERT_EQ(plot.curves.size(), 2u);
  EXPECT_EQ(plot.curves_are, "profile");
  EXPECT_EQ(plot.curves[1].label, "profile b");
  ASSERT_EQ(plot.curves[1].marks.size(), 2u);
  const Plot::Mark& mark = plot.curves[1].marks[1];
  EXPECT_EQ(mark.x, 2);
  EXPECT_DOUBLE_EQ(mark.y, 122);
  EXPECT_EQ(mark.count, 5u);
  EXPECT_NEAR(mark.interval->high - mark.y, 2.776445 * std::sqrt(2.5 / 5), 1e-5);
  EXPECT_EQ(plot.x_label, "speed / m/s");
  EXPECT_EQ(plot.y_label, "x / s");
  EXPECT_TRUE(plot.notes.empty());
}

/// Five runs of which one lost a message, and one gave a request up.
Experiment nearly_all() {
  Experiment experiment;
  experiment.points.resize(1);
  for (std::size_t run = 0; run < 5; ++run) {
    experiment.points[0].runs.push_back(run);
    experiment.runs.push_back({"run", 0, run});
    experiment.values[{"messages.delivery_ratio", ""}][run] = run == 2 ? 0.99 : 1;
    experiment.values[{"messages.sent", ""}][run] = 100;
    experiment.values[{"requests.retry_limit", ""}][run] = run == 2 ? 1 : 0;
    experiment.values[{"controllers.gap.last", ""}][run] = run == 2 ? 1 : 0;
  }
  for (const auto& [quantity, by_run] : experiment.values) experiment.units[quantity.name] = "1";
  return experiment;
}

TEST(PlotTest, IntervalsOfSharesAndCountsStayInTheirRange) {
  const Experiment experiment = nearly_all();
  const auto interval = [&](const char* name, sim::scenario::IntervalKind kind) {
    return *make_plot(experiment,
                      {.plot = name, .as = sim::scenario::PlotKind::kPoints, .interval = kind})
                .curves[0]
                .marks[0]
                .interval;
  };
  for (const sim::scenario::IntervalKind kind :
       {sim::scenario::IntervalKind::kStudent, sim::scenario::IntervalKind::kBootstrap}) {
    EXPECT_LE(interval("messages.delivery_ratio", kind).high, 1);
    EXPECT_GT(interval("messages.delivery_ratio", kind).low, 0.9);
    EXPECT_GE(interval("requests.retry_limit", kind).low, 0);
  }
  EXPECT_LT(interval("controllers.gap.last", sim::scenario::IntervalKind::kStudent).low, 0)
      << "may be anything";
  const std::string text = quantities_text(experiment);
  EXPECT_EQ(text.find("1.00"), std::string::npos) << text;
  EXPECT_NE(plot_text(make_plot(experiment, {.plot = "requests.retry_limit",
                                             .as = sim::scenario::PlotKind::kPoints}))
                .find("(score by Student's t)"),
            std::string::npos);
}

// All of 500 messages arrived: Wilson's interval of 500 trials, not one without width.
TEST(PlotTest, AShareOfOneKnowsOfHowManyTrials) {
  Experiment experiment = nearly_all();
  for (auto& [run, ratio] : experiment.values[{"messages.delivery_ratio", ""}]) ratio = 1;
  const Plot plot = make_plot(
      experiment, {.plot = "messages.delivery_ratio", .as = sim::scenario::PlotKind::kPoints});
  const double z2 = 3.841459;
  EXPECT_NEAR(plot.curves[0].marks[0].interval->low, 500 / (500 + z2), 1e-7);
  EXPECT_EQ(plot.curves[0].marks[0].interval->high, 1);
}

TEST(PlotTest, SettingsWithoutNumbersStandSideBySide) {
  const Plot plot = make_plot(two_by_two(), {.plot = "x", .versus = "profile"});
  EXPECT_EQ(plot.categories, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(plot.curves[0].label, "speed 1 m/s");
  EXPECT_EQ(plot.curves[0].marks[1].x, 1);
}

// Another setting that differs is never averaged over, whatever `by` says.
TEST(PlotTest, ThreeSettingsThatDifferAreNeverPooled) {
  Experiment experiment = two_by_two();
  experiment.factors.push_back({"load", ""});
  for (std::size_t i = 0; i < experiment.points.size(); ++i) {
    const bool is_high = i == 3;
    experiment.points[i].levels.push_back({is_high ? "high" : "low", std::nullopt});
  }
  const Plot plot = make_plot(experiment, {.plot = "x", .versus = "speed", .by = "load"});
  ASSERT_EQ(plot.curves.size(), 3u);
  for (const Plot::Curve& curve : plot.curves) {
    for (const Plot::Mark& mark : curve.marks) EXPECT_EQ(mark.count, 5u) << curve.label;
  }
}

TEST(PlotTest, WhatIsNotThereIsNamedWithWhatIs) {
  const Experiment experiment = two_by_two();
  EXPECT_NE(message_of(experiment, {.plot = "y"}).find("y: none of these runs has such a quantity"),
            std::string::npos);
  EXPECT_NE(message_of(experiment, {.plot = "x", .versus = "sped"}).find("agents.r.speed"),
            std::string::npos);
  EXPECT_NE(message_of(experiment, {.plot = "x", .agent = "r0"}).find("for 'r0'"),
            std::string::npos);
  EXPECT_NE(
      message_of(experiment, {.plot = "x", .as = sim::scenario::PlotKind::kTime}).find("over time"),
      std::string::npos);
}

TEST(PlotTest, AStateMayBeWrittenInCapitalsAsItsControllerDoes) {
  Experiment experiment = two_by_two();
  experiment.units["states.arrived.first"] = "s";
  experiment.values[{"states.arrived.first", ""}] = experiment.values[{"x", ""}];
  EXPECT_EQ(make_plot(experiment, {.plot = "states.ARRIVED.first"}).y_label,
            "states.arrived.first / s");
  EXPECT_NE(message_of(experiment, {.plot = "states.LEFT.first"}).find("no"), std::string::npos);
}

TEST(PlotTest, FewRunsAreWarnedOf) {
  Experiment experiment = two_by_two();
  experiment.points[0].runs.resize(3);
  Plot plot = make_plot(experiment, {.plot = "x"});
  ASSERT_EQ(plot.notes.size(), 1u);
  EXPECT_NE(plot.notes[0].find("only 3 runs"), std::string::npos);
  experiment.points[0].runs.resize(1);
  plot = make_plot(experiment, {.plot = "x"});
  EXPECT_NE(plot.notes[0].find("one run"), std::string::npos);
  EXPECT_FALSE(plot.curves[0].marks[0].interval);
}

TEST(PlotTest, ABootstrapIntervalOfFewRunsIsWarnedOfAndInsideTheirRange) {
  const Plot plot =
      make_plot(two_by_two(), {.plot = "x", .interval = sim::scenario::IntervalKind::kBootstrap});
  const Plot::Mark& mark = plot.curves[0].marks[0];
  EXPECT_GE(mark.interval->low, 10);
  EXPECT_LE(mark.interval->high, 14);
  EXPECT_LT(mark.interval->low, mark.y);
  ASSERT_EQ(plot.notes.size(), 1u);
  EXPECT_NE(plot.notes[0].find("bootstrap"), std::string::npos);
}

TEST(PlotTest, AHistogramCountsEachValueOnce) {
  const Experiment experiment = two_by_two();
  const Plot plot = make_plot(experiment, {.plot = "x", .as = sim::scenario::PlotKind::kHistogram});
  std::size_t count = 0;
  for (const Plot::Curve& curve : plot.curves) {
    for (const Plot::Mark& mark : curve.marks) count += mark.count;
  }
  EXPECT_EQ(plot.curves.size(), 4u);
  EXPECT_EQ(count, experiment.runs.size());
}

TEST(PlotTest, RecordedBinsAreAddedUpAndThoseWithoutEndsNamed) {
  Experiment experiment = two_by_two();
  experiment.units["h"] = "m";
  const double infinity = std::numeric_limits<double>::infinity();
  for (const std::size_t run : {0u, 1u}) {
    experiment.bins[{"h", ""}][run] = {{0, 1, 4}, {1, 2, 6}, {2, infinity, 1}};
  }
  const Plot plot = make_plot(experiment, {.plot = "h", .as = sim::scenario::PlotKind::kHistogram});
  ASSERT_EQ(plot.curves.size(), 1u);
  ASSERT_EQ(plot.curves[0].marks.size(), 2u);
  EXPECT_EQ(plot.curves[0].marks[1].count, 12u);
  ASSERT_EQ(plot.notes.size(), 1u);
  EXPECT_NE(plot.notes[0].find("2 values from 2 are beyond"), std::string::npos) << plot.notes[0];
}

/// One setting, two runs of r0 and r1, sampled each second, at 100 at first and then at 0 or 2.
Experiment over_time() {
  Experiment experiment;
  experiment.units = {{"z", "m"}};
  experiment.points.resize(1);
  for (const std::size_t run : {0u, 1u}) {
    experiment.points[0].runs.push_back(run);
    experiment.runs.push_back({"run", 0, run});
    for (const char* agent : {"r0", "r1"}) {
      for (int i = 0; i < 100; ++i) {
        experiment.series[{"z", agent}][run].emplace_back(
            i, i < 10 ? 100 : 2.0 * static_cast<double>(run));
      }
    }
  }
  return experiment;
}

TEST(PlotTest, ACourseIsTheMeanOverRunsAndAgentsAndItsWarmUpIsNamed) {
  const Plot plot = make_plot(over_time(), {.plot = "z"});
  EXPECT_EQ(plot.kind, sim::scenario::PlotKind::kTime);
  ASSERT_EQ(plot.curves.size(), 1u);
  ASSERT_EQ(plot.curves[0].marks.size(), 100u);
  EXPECT_EQ(plot.curves[0].marks[5].y, 100);
  EXPECT_EQ(plot.curves[0].marks[50].y, 1);
  EXPECT_EQ(plot.curves[0].marks[50].count, 2u);
  EXPECT_NE(plot.notes[0].find("warm-up by MSER-5 until 10 s"), std::string::npos) << plot.notes[0];
}

// Recorded on change: 5 from 1 s, in one run 7 from 3 s; both last 1000 s. Nothing changes after.
TEST(PlotTest, TheLastValueHoldsUntilTheRunsEnd) {
  Experiment experiment = over_time();
  experiment.series.clear();
  experiment.series[{"z", "r0"}] = {{0, {{1, 5}}}, {1, {{1, 5}, {3, 7}}}};
  experiment.units["run.simulated"] = "s";
  experiment.values[{"run.simulated", ""}] = {{0, 1000}, {1, 1000}};
  const Plot plot = make_plot(experiment, {.plot = "z"});
  EXPECT_EQ(plot.curves[0].marks.back().x, 1000);
  EXPECT_EQ(plot.curves[0].marks.back().y, 6);
  EXPECT_EQ(plot.curves[0].marks.front().x, 1);
  EXPECT_NE(plot.notes[0].find("warm-up by MSER-5"), std::string::npos) << plot.notes[0];
}

TEST(PlotTest, CoursesSampledAtOtherTimesMeetOnCommonOnes) {
  Experiment experiment = over_time();
  for (auto& [at, value] : experiment.series[{"z", "r0"}][1]) at += 0.5;
  const Plot plot = make_plot(experiment, {.plot = "z", .agent = "r0"});
  EXPECT_EQ(plot.curves[0].marks.size(), 200u);
  EXPECT_EQ(plot.curves[0].marks.front().x, 0.5);
  EXPECT_EQ(plot.curves[0].marks.back().x, 99);
}

TEST(PlotTest, AQuantityOfAgentsIsTheirMeanOrOnesOwn) {
  Experiment experiment = two_by_two();
  experiment.units["e"] = "J";
  for (std::size_t run = 0; run < experiment.runs.size(); ++run) {
    experiment.values[{"e", "m0"}][run] = 1;
    experiment.values[{"e", "m1"}][run] = 3;
  }
  EXPECT_EQ(make_plot(experiment, {.plot = "e"}).curves[0].marks[0].y, 2);
  EXPECT_EQ(make_plot(experiment, {.plot = "e"}).title, "e (mean of 2 agents)");
  EXPECT_EQ(make_plot(experiment, {.plot = "e", .agent = "m1"}).curves[0].marks[0].y, 3);
}

TEST(PlotTest, TheDrawingHasAMarkPerPointAndALegend) {
  const std::string drawing = svg(make_plot(two_by_two(), {.plot = "x", .versus = "speed"}));
  EXPECT_EQ(count_of(drawing, "class=\"point\""), 4u);
  EXPECT_EQ(count_of(drawing, "class=\"interval\""), 4u);
  EXPECT_EQ(count_of(drawing, "class=\"legend\""), 1u);
  EXPECT_EQ(drawing.find("nan"), std::string::npos);
}

TEST(PlotTest, NamesCannotBreakTheDrawing) {
  Experiment experiment = two_by_two();
  experiment.points[0].levels[1].text = "<a&\"b\">";
  const std::string drawing = svg(make_plot(experiment, {.plot = "x", .versus = "speed"}));
  EXPECT_EQ(drawing.find("<a&"), std::string::npos);
  EXPECT_NE(drawing.find("&lt;a&amp;&quot;b&quot;&gt;"), std::string::npos);
}

TEST(PlotTest, EqualValuesCanBeDrawn) {
  Experiment experiment = two_by_two();
  for (auto& [run, value] : experiment.values[{"x", ""}]) value = 0;
  const std::string drawing = svg(make_plot(experiment, {.plot = "x"}));
  EXPECT_EQ(drawing.find("nan"), std::string::npos);
  EXPECT_EQ(drawing.find("inf"), std::string::npos);
}

TEST(PlotTest, OneSampleCanBeDrawn) {
  Experiment experiment = over_time();
  for (auto& [quantity, by_run] : experiment.series) {
    for (auto& [run, series] : by_run) series.resize(1);
  }
  const Plot plot = make_plot(experiment, {.plot = "z"});
  EXPECT_EQ(plot.curves[0].marks.size(), 1u);
  const std::string drawing = svg(plot);
  EXPECT_EQ(drawing.find("nan"), std::string::npos) << drawing;
  EXPECT_EQ(drawing.find("inf"), std::string::npos) << drawing;
}

TEST(PlotTest, TicksOfASmallSpanFarFromZeroAreWithinIt) {
  const auto values = ticks(1.7e9 - 1e-4, 1.7e9 + 1e-4, 6);
  EXPECT_GT(values.size(), 3u);
  EXPECT_LT(values.size(), 13u);
  for (const double value : values) EXPECT_NEAR(value, 1.7e9, 2e-4);
}

TEST(PlotTest, TicksAreRoundAndWithinTheAxis) {
  EXPECT_EQ(ticks(0, 10, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  ASSERT_EQ(ticks(-0.4, 0.9, 3).size(), 2u);
  EXPECT_EQ(ticks(-0.4, 0.9, 3)[0], 0);
  EXPECT_DOUBLE_EQ(ticks(-0.4, 0.9, 3)[1], 0.5);
}

TEST(PlotTest, TheDataOfAFigureAreExactInAFile) {
  Experiment experiment = two_by_two();
  for (auto& [run, value] : experiment.values[{"x", ""}]) value = 1234567.25;
  const Plot plot = make_plot(experiment, {.plot = "x", .versus = "speed"});
  EXPECT_EQ(plot_rows(plot, Digits::kExact)[1][3], "1234567.25");
  EXPECT_EQ(plot_rows(plot)[1][3], "1.23457e+06");
}

TEST(PlotTest, AnAxisIsNotIgnoredForACourse) {
  Experiment experiment = over_time();
  experiment.factors = {{"speed", ""}};
  experiment.points[0].levels = {{"1", 1.0}};
  experiment.units["z.mean"] = "m";
  EXPECT_NE(message_of(experiment, {.plot = "z", .versus = "speed"}).find("z.mean"),
            std::string::npos);
}

TEST(PlotTest, AnUnknownNameIsAnsweredWithThoseThatHoldIt) {
  Experiment experiment = two_by_two();
  experiment.units["run.simulated"] = "s";
  EXPECT_NE(message_of(experiment, {.plot = "simulated_s"}).find("run.simulated"),
            std::string::npos);
}

// Each partner is 100 s later with radio b, whatever the seed: nothing varies in the differences.
/// r0 and r1 record 3 and 5 values known; r0's speed was kept as sums, the battery of both over
/// time.
Experiment of_agents() {
  Experiment experiment;
  experiment.points.push_back({{}, {0}});
  experiment.runs.push_back({"run", 0, 1});
  experiment.units = {{"controllers.known", "1"},
                      {"controllers.known.mean", "1"},
                      {"agents.speed.mean", "m/s"},
                      {"agents.x", "m"},
                      {"sensors.x", "m"}};
  for (const char* agent : {"r0", "r1"}) {
    experiment.series[{"controllers.known", agent}][0] = {{0, 1}, {1, *agent == 'r' ? 3 : 5}};
    experiment.values[{"controllers.known.mean", agent}][0] = 2;
  }
  experiment.values[{"agents.speed.mean", "r0"}][0] = 0.5;
  return experiment;
}

TEST(PlotTest, AQuantityIsFoundByTheNamesThatTheViewAndTheDocsShow) {
  const Experiment experiment = of_agents();
  const auto found = [&](const std::string& name) {
    const sim::scenario::PlotRequest request = with_full_name(experiment, {.plot = name});
    return request.plot + " of '" + request.agent + "'";
  };
  EXPECT_EQ(found("known"), "controllers.known of ''");
  EXPECT_EQ(found("controllers.r1.known"), "controllers.known of 'r1'");
  EXPECT_EQ(found("controllers.*.known"), "controllers.known of ''");
  EXPECT_EQ(found("agents.r0.speed"), "agents.speed.mean of 'r0'");
  EXPECT_EQ(found("speed"), "agents.speed.mean of ''");
  EXPECT_EQ(found("controllers.r9.known"), "controllers.r9.known of ''") << "there is no r9";
  EXPECT_EQ(make_plot(experiment, {.plot = "controllers.r1.known"}).name, "controllers.known.r1");
  EXPECT_NE(message_of(experiment, {.plot = "knowm"}).find("did you mean 'controllers.known'?"),
            std::string::npos);
  EXPECT_EQ(message_of(experiment, {.plot = "x"}), "x: which of agents.x, sensors.x?");
}

TEST(PlotTest, WhatAScenarioObservedIsShownWithoutBeingAskedForAgain) {
  Experiment experiment = of_agents();
  EXPECT_TRUE(requests_of(experiment).empty());
  experiment.observables = sim::scenario::observables_of(
      "name: a\nrecord:\n  poses: all\n  observables:\n    - name: controllers.*.known\n"
      "      every: 1 s\n    - name: agents.r0.speed\n  frames: all\nagents:\n  x:\n    name: y\n");
  EXPECT_EQ(experiment.observables,
            (std::vector<std::string>{"controllers.*.known", "agents.r0.speed"}));
  const auto requests = requests_of(experiment);
  ASSERT_EQ(requests.size(), 2u);
  EXPECT_EQ(requests[0].plot, "controllers.known");
  EXPECT_EQ(requests[0].as, sim::scenario::PlotKind::kTime);
  EXPECT_EQ(requests[1].plot, "agents.speed.mean");
  EXPECT_EQ(requests[1].agent, "r0");
  for (const sim::scenario::PlotRequest& request : requests)
    EXPECT_FALSE(make_plot(experiment, request).name.empty());
}

TEST(PlotTest, PairsAreOfEqualSeeds) {
  const Experiment experiment = two_by_two();
  const std::string text = pairs_text(experiment, {.plot = "x"});
  EXPECT_NE(text.find("difference to speed 1 m/s, profile a"), std::string::npos) << text;
  EXPECT_NE(text.find("speed 1 m/s, profile b      5         100       100   100  -"),
            std::string::npos)
      << text;
}

// 0.1 + 0.2 is not 0.3: a difference of the last digit says nothing.
TEST(PlotTest, RoundingHasNoPValue) {
  Experiment experiment = two_by_two();
  for (auto& [run, value] : experiment.values[{"x", ""}]) {
    value = run < 5 ? 0.3 : run % 2 == 0 ? 0.1 + 0.2 : 0.3;
  }
  const std::string text = pairs_text(experiment, {.plot = "x"});
  EXPECT_NE(text.find("  -            -\n"), std::string::npos) << text;
}

TEST(PlotTest, WithoutARequestTheRunsQuantitiesThatDifferAreShown) {
  Experiment experiment = two_by_two();
  EXPECT_TRUE(requests_of(experiment).empty());
  experiment.units["run.simulated"] = "s";
  experiment.values[{"run.simulated", ""}] = experiment.values[{"x", ""}];
  ASSERT_EQ(requests_of(experiment).size(), 1u);
  EXPECT_EQ(requests_of(experiment)[0].plot, "run.simulated");
}

}  // namespace
}  // namespace results::report::test
