#include "results/report/chart.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <regex>
#include <stdexcept>

#include "results/report/axis.h"

namespace results::report::test {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::size_t occurrences(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; ++at) ++count;
  return count;
}

/// First match of the expression's group, as a number.
double number_in(const std::string& text, const std::string& expression) {
  std::smatch found;
  if (!std::regex_search(text, found, std::regex(expression))) {
    ADD_FAILURE() << expression << " is not in\n" << text;
    return kNaN;
  }
  return std::stod(found[1]);
}

Chart chart_of(std::vector<Chart::Layer> layers) {
  Chart chart;
  chart.panels.push_back({.layers = std::move(layers)});
  return chart;
}

std::string message_of(const Chart& chart) {
  try {
    svg(chart);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "no error";
}

/// The frame of the only panel: its axes are "M left,top V bottom H right".
Frame frame_in(const std::string& drawing, const Chart& chart) {
  const Limits limits = limits_of(chart).at(0);
  Frame frame{limits.x, limits.y};
  const std::string axes = "<g class=\"axis\"[^>]*>\n<path d=\"";
  frame.x.from = number_in(drawing, axes + "M([0-9.]+),");
  frame.y.to = number_in(drawing, axes + "M[0-9.]+,([0-9.]+)V");
  frame.y.from = number_in(drawing, axes + "[^\"]*V([0-9.]+)");
  frame.x.to = number_in(drawing, axes + "[^\"]*H([0-9.]+)");
  return frame;
}

TEST(AxisTest, DecadesAreEquallyLongOnALogarithmicScale) {
  const Axis axis{.low = 0.01, .high = 100, .from = 300, .to = 100, .is_log = true};
  EXPECT_DOUBLE_EQ(axis.at(0.01), 300);
  EXPECT_NEAR(axis.at(0.1), 250, 1e-9);  // px
  EXPECT_NEAR(axis.at(1), 200, 1e-9);
  EXPECT_DOUBLE_EQ(axis.at(100), 100);
  EXPECT_TRUE(axis.holds(100));
  EXPECT_FALSE(axis.holds(101));
  EXPECT_FALSE(axis.is_drawable(0));
  EXPECT_FALSE(axis.is_drawable(-1));
  EXPECT_FALSE(axis.is_drawable(kInfinity));
}

TEST(AxisTest, TicksOfALogarithmicScaleArePowersOfTen) {
  const std::vector<double> decades = log_ticks(1e-6, 1.5, 8);
  ASSERT_EQ(decades.size(), 7u);
  for (std::size_t i = 0; i < decades.size(); ++i)
    EXPECT_NEAR(decades[i] / std::pow(10, static_cast<double>(i) - 6), 1, 1e-12);
  EXPECT_EQ(log_ticks(1e-6, 1.5, 4).size(), 4u) << "every second one";
  const std::vector<double> few = log_ticks(2, 60, 8);
  ASSERT_EQ(few.size(), 5u);
  for (std::size_t i = 0; i < few.size(); ++i)
    EXPECT_NEAR(few[i], (std::vector<double>{2, 5, 10, 20, 50})[i], 1e-12);
}

TEST(ChartTest, AMarkIsWhereItsValuesAreOnBothAxes) {
  Chart chart = chart_of({Chart::Marks{.x = {10}, .y = {0.1}}});
  chart.panels[0].x = {.low = 0, .high = 40};
  chart.panels[0].y = {.is_log = true, .low = 0.001, .high = 1};
  const std::string drawing = svg(chart);
  const Frame frame = frame_in(drawing, chart);
  const std::string place = "class=\"point\"[^>]*translate\\(";
  EXPECT_NEAR(number_in(drawing, place + "([0-9.]+),"),
              frame.left() + (frame.right() - frame.left()) / 4, 0.005);  // written in 0.01 px
  EXPECT_NEAR(number_in(drawing, place + "[0-9.]+,([0-9.]+)"),
              frame.top() + (frame.bottom() - frame.top()) / 3, 0.005);
  EXPECT_EQ(drawing.find("not shown"), std::string::npos);
}

TEST(ChartTest, StackedBarsBeginWhereTheOneBelowEnds) {
  const Chart chart = chart_of(
      {Chart::Bars{.at = {0, 1},
                   .is_stacked = true,
                   .series = {{.y = {1, 2}}, {.y = {3, kNaN}}, {.y = {4, 5}}, {.y = {-1, -2}}}}});
  const auto& bars = std::get<Chart::Bars>(chart.panels[0].layers[0]);
  EXPECT_EQ(ends_of(bars, 2, 0).from, 4);
  EXPECT_EQ(ends_of(bars, 2, 0).to, 8);
  EXPECT_EQ(ends_of(bars, 2, 1).from, 2) << "above what is a number";
  EXPECT_EQ(ends_of(bars, 3, 1).from, 0) << "below 0";
  EXPECT_GT(limits_of(chart)[0].y.high, 8);
  EXPECT_LT(limits_of(chart)[0].y.low, -2);
  const std::string drawing = svg(chart);
  EXPECT_EQ(occurrences(drawing, "class=\"bin\""), 7u);
  EXPECT_NE(drawing.find("not shown: 1 without a position"), std::string::npos);
}

TEST(ChartTest, BarsSideBySideShareTheirPlaceAndStandOnZero) {
  const Chart chart = chart_of(
      {Chart::Bars{.at = {0}, .width = 0.8, .series = {{.y = {2}, .texts = {"two"}}, {.y = {4}}}}});
  const std::string drawing = svg(chart);
  const Frame frame = frame_in(drawing, chart);
  EXPECT_EQ(frame.y.low, 0);
  const std::regex bin(
      "class=\"bin\" x=\"([0-9.]+)\" y=\"([0-9.]+)\" width=\"([0-9.]+)\" height=\"([0-9.]+)\"");
  std::vector<std::smatch> found;
  for (std::sregex_iterator at(drawing.begin(), drawing.end(), bin), end; at != end; ++at)
    found.push_back(*at);
  ASSERT_EQ(found.size(), 2u);
  for (const std::smatch& one : found)
    EXPECT_NEAR(std::stod(one[2]) + std::stod(one[4]), frame.bottom(), 0.01);
  EXPECT_NEAR(std::stod(found[0][1]) + std::stod(found[0][3]), std::stod(found[1][1]), 0.015);
  EXPECT_NEAR(2 * std::stod(found[0][4]), std::stod(found[1][4]), 0.015);
  EXPECT_EQ(occurrences(drawing, ">two</text>"), 1u);
}

TEST(ChartTest, AnIntervalThatLeavesTheLimitsHasNoCapThere) {
  Chart chart = chart_of({Chart::Marks{.x = {0, 1}, .y = {2, 2}, .low = {1, -3}, .high = {3, 4}}});
  chart.panels[0].y = {.low = 0, .high = 5};
  const std::string drawing = svg(chart);
  EXPECT_EQ(occurrences(drawing, "class=\"interval\""), 2u);
  EXPECT_EQ(occurrences(drawing, "h8m-4,0V"), 1u) << "both begin, one with a cap";
  EXPECT_EQ(occurrences(drawing, "m-4,0h8"), 2u);
  const Frame frame = frame_in(drawing, chart);
  const double per_unit = (frame.bottom() - frame.top()) / 5;
  EXPECT_NEAR(number_in(drawing, "class=\"interval\"[^>]*d=\"M[0-9.]+,([0-9.]+)h8"),
              frame.bottom() - per_unit, 0.005);
  chart.panels[0].layers = {Chart::Marks{.x = {0}, .y = {2}, .low = {kNaN}, .high = {3}}};
  EXPECT_NE(svg(chart).find("not shown: 1 without a position"), std::string::npos);
}

TEST(ChartTest, WhatIsOutsideTheLimitsIsCountedInANote) {
  Chart chart = chart_of({Chart::Marks{.x = {0, 1, 2}, .y = {1, 7, -1}}});
  chart.panels[0].y = {.low = 0, .high = 5};
  std::string drawing = svg(chart);
  EXPECT_EQ(occurrences(drawing, "class=\"point\""), 1u);
  EXPECT_NE(drawing.find("not shown: 2 outside the limits<"), std::string::npos);
  for (const Chart::Layer& layer :
       std::vector<Chart::Layer>{Chart::Bars{.at = {0}, .series = {{.y = {6}}}},
                                 Chart::Reference{.at = 9, .is_upright = false},
                                 Chart::Line{.x = {1}, .y = {9}}, Chart::Text{{}, 1, 9, "far"}}) {
    chart.panels[0].layers = {layer};
    EXPECT_NE(svg(chart).find("not shown: 1 outside the limits<"), std::string::npos);
  }
}

TEST(ChartTest, ALineIsCutOffAtTheFrame) {
  Chart chart = chart_of({Chart::Line{.x = {0, 1}, .y = {1, 100}}});
  chart.panels[0].y = {.low = 0, .high = 5};
  const std::string drawing = svg(chart);
  const Frame frame = frame_in(drawing, chart);
  const std::string clip = "<svg class=\"clip\"[^>]*";
  EXPECT_EQ(number_in(drawing, clip + " y=\"([0-9.]+)\""), frame.top());
  EXPECT_EQ(number_in(drawing, clip + " height=\"([0-9.]+)\""), frame.bottom() - frame.top());
  EXPECT_LT(drawing.find("class=\"clip\""), drawing.find("class=\"line\""));
}

TEST(ChartTest, ALineHasAGapWhereAValueHasNoPosition) {
  Chart chart = chart_of({Chart::Line{.x = {0, 1, 2, 3, 4}, .y = {1, 2, kNaN, 3, 4}}});
  std::string drawing = svg(chart);
  std::smatch path;
  ASSERT_TRUE(std::regex_search(drawing, path, std::regex("class=\"line\"[^>]* d=\"([^\"]+)\"")));
  EXPECT_TRUE(std::regex_match(path[1].str(), std::regex("M[0-9.,]+L[0-9.,]+M[0-9.,]+L[0-9.,]+")))
      << path[1];
  EXPECT_NE(drawing.find("not shown: 1 without a position"), std::string::npos);

  chart.panels[0].layers = {Chart::Line{.x = {1, 2, 3}, .y = {0, 1, -1}}};
  chart.panels[0].y.is_log = true;
  drawing = svg(chart);
  EXPECT_NE(drawing.find("not shown: 2 without a position"), std::string::npos);
  EXPECT_NE(drawing.find("h1.5\""), std::string::npos) << "what is left of it is seen";
}

TEST(ChartTest, NothingThatIsNotFiniteIsWritten) {
  Chart chart =
      chart_of({Chart::Marks{.x = {kNaN, 1, 2}, .y = {1, kInfinity, 3}},
                Chart::Bars{.at = {1, kNaN}, .series = {{.y = {-kInfinity, 1}}}},
                Chart::Reference{.at = kNaN}, Chart::Span{{}, kNaN, 1},
                Chart::Line{.x = {1, 2}, .y = {kNaN, kNaN}}, Chart::Text{{}, kNaN, 1, "t"}});
  const std::string drawing = svg(chart);
  EXPECT_EQ(drawing.find("nan"), std::string::npos) << drawing;
  EXPECT_EQ(drawing.find("inf"), std::string::npos) << drawing;
  EXPECT_NE(drawing.find("not shown: 9 without a position"), std::string::npos) << drawing;
}

TEST(ChartTest, AnEmptySeriesIsInTheLegendOnly) {
  const std::string drawing =
      svg(chart_of({Chart::Line{.style = {.label = "ours"}},
                    Chart::Marks{.style = {.label = "theirs"}}, Chart::Bars{}}));
  EXPECT_EQ(occurrences(drawing, ">ours</text>"), 1u);
  EXPECT_EQ(occurrences(drawing, ">theirs</text>"), 1u);
  EXPECT_EQ(occurrences(drawing, "class=\"line\""), 0u);
  EXPECT_EQ(occurrences(drawing, "class=\"point\""), 0u);
  EXPECT_EQ(drawing.find("not shown"), std::string::npos);
  EXPECT_EQ(drawing.find("nan"), std::string::npos);
}

TEST(ChartTest, ALineAndMarksOfOneLabelAreOneEntry) {
  const Chart::Style style{.label = "ours", .curve = 1};
  const std::string drawing =
      svg(chart_of({Chart::Line{.style = style, .x = {1, 2}, .y = {1, 2}},
                    Chart::Marks{.style = style, .x = {1, 2}, .y = {1, 2}}}));
  EXPECT_EQ(occurrences(drawing, ">ours</text>"), 1u);
  EXPECT_EQ(occurrences(drawing, "class=\"curve curve-1\" color=\"#D55E00\""), 2u);
}

TEST(ChartTest, AStepHoldsUntilTheNextValue) {
  const std::string drawing =
      svg(chart_of({Chart::Line{.x = {0, 1, 2}, .y = {1, 2, 3}, .is_stepped = true}}));
  EXPECT_TRUE(std::regex_search(
      drawing, std::regex("class=\"line\"[^>]* d=\"M[0-9.,]+H[0-9.]+V[0-9.]+H[0-9.]+V[0-9.]+\"")));
}

TEST(ChartTest, PanelsAreInAGridAndCanShareTheirLimits) {
  Chart chart = chart_of({Chart::Line{.x = {0, 1}, .y = {0, 10}}});
  chart.panels.push_back({.layers = {Chart::Line{.x = {5, 6}, .y = {20, 30}}}});
  chart.panels.push_back({.layers = {}});
  chart.columns = 2;
  chart.shares_y = true;
  const std::vector<Limits> limits = limits_of(chart);
  for (const Limits& one : limits) {
    EXPECT_EQ(one.y.low, 0);
    EXPECT_EQ(one.y.high, 31.5);
  }
  EXPECT_NE(limits[0].x.low, limits[1].x.low);
  const std::string drawing = svg(chart);
  const std::regex axes("<g class=\"axis\"[^>]*>\n<path d=\"M([0-9.]+),([0-9.]+)V");
  std::vector<std::pair<std::string, std::string>> corners;
  for (std::sregex_iterator at(drawing.begin(), drawing.end(), axes), end; at != end; ++at)
    corners.emplace_back((*at)[1], (*at)[2]);
  ASSERT_EQ(corners.size(), 3u);
  EXPECT_EQ(corners[0].second, corners[1].second);
  EXPECT_EQ(corners[0].first, corners[2].first);
  EXPECT_NEAR(std::stod(corners[1].first) - std::stod(corners[0].first), chart.width / 2, 1);
  EXPECT_NEAR(std::stod(corners[2].second) - std::stod(corners[0].second), chart.height / 2, 1);
}

TEST(ChartTest, NamesThatAreWiderThanTheirPlacesAreSlanted) {
  Chart chart = chart_of({Chart::Bars{.at = {0, 1, 2}, .series = {{.y = {1, 2, 3}}}}});
  chart.panels[0].x.names = {"a", "b", "<c>"};
  EXPECT_EQ(svg(chart).find("rotate(-45)"), std::string::npos);
  EXPECT_NE(svg(chart).find("&lt;c&gt;"), std::string::npos);
  chart.panels[0].x.names = std::vector<std::string>(3, std::string(50, 'w'));
  EXPECT_NE(svg(chart).find("rotate(-45)"), std::string::npos);
}

TEST(ChartTest, WhatCannotBeDrawnIsSaid) {
  EXPECT_EQ(message_of({}), "there is no panel");
  EXPECT_EQ(message_of(chart_of({Chart::Line{.x = {1, 2}, .y = {1}}})),
            "y of a line: 1 values, not 2");
  EXPECT_EQ(message_of(chart_of({Chart::Marks{.x = {1}, .y = {1}, .low = {0}}})),
            "high ends of intervals: 0 values, not 1");
  Chart chart = chart_of({});
  chart.panels[0].y = {.label = "delay", .is_log = true, .low = 0, .high = 1};
  EXPECT_EQ(message_of(chart), "'delay': a logarithmic axis cannot begin at 0");
  chart.panels[0].y = {.label = "delay", .low = 2, .high = 1};
  EXPECT_EQ(message_of(chart), "'delay': 2 .. 1 are no limits");
  chart.panels[0].y = {};
  chart.height = 50;
  EXPECT_EQ(message_of(chart), "the panels are too small for their texts");
}

TEST(ChartTest, EqualChartsGiveEqualBytes) {
  const Chart chart = chart_of({Chart::Line{.x = {0, 1}, .y = {0.1, 0.3}}});
  EXPECT_EQ(svg(chart), svg(Chart(chart)));
}

}  // namespace
}  // namespace results::report::test
