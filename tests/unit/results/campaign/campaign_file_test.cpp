#include "results/campaign/campaign_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <set>

#include "hal/files/config/errors.h"
#include "results/campaign/factors.h"
#include "results/campaign/latin_hypercube.h"
#include "tests/unit/results/record/test_run.h"

namespace results::campaign {
namespace {

using testing::ElementsAre;

/// Of a file with that text behind the keys that must be there.
CampaignFile read(const std::string& text) {
  const record::test::Folder folder("campaign_file");
  const auto file = folder.path() / "speeds.yaml";
  std::ofstream(file) << "version: 1\nscenario: s.yaml\n" << text;
  return load_campaign(file);
}

/// "line:column: key: what is wrong" of its mistakes.
std::vector<std::string> mistakes(const std::string& text) {
  try {
    read(text);
  } catch (const hal::files::config::ConfigErrors& errors) {
    std::vector<std::string> lines;
    for (const std::string& message : errors.messages()) {
      lines.push_back(message.substr(message.find("speeds.yaml:") + 12));
    }
    return lines;
  }
  return {};
}

std::vector<std::string> labels(const CampaignFile& campaign) {
  std::vector<std::string> all;
  for (const PointRow& point : factor_table(campaign.keys, campaign.points).points) {
    all.push_back(point.label);
  }
  return all;
}

TEST(CampaignFile, WithoutADesignHasOnePoint) {
  const CampaignFile campaign = read("replications: 3\n");
  EXPECT_EQ(campaign.name, "speeds");
  EXPECT_EQ(campaign.design, Design::kOnePoint);
  EXPECT_EQ(campaign.points.size(), 1U);
  EXPECT_EQ(campaign.replications, 3);
  EXPECT_EQ(campaign.seeds, Seeds::kCommon);
  EXPECT_EQ(campaign.keep, Keep::kNone);
  EXPECT_FALSE(campaign.jobs);
  EXPECT_FALSE(campaign.until);
  EXPECT_EQ(campaign.pace, "lockstep");
}

TEST(CampaignFile, AGridHasEveryCombinationTheFirstKeySlowest) {
  const CampaignFile campaign =
      read("vary:\n  a.speed: [1 m/s, 20 cm/s]\n  radio.profile: [x, y]\n");
  EXPECT_THAT(labels(campaign),
              ElementsAre("speed=1 m/s, profile=x", "speed=1 m/s, profile=y",
                          "speed=20 cm/s, profile=x", "speed=20 cm/s, profile=y"));
}

TEST(CampaignFile, ValuesOfAnyKindAreWrittenAsForTheCommandLine) {
  const CampaignFile campaign =
      read("vary:\n  a.list: [[1 m, 2 m], {b: [c, \"d: e\"]}, ~, \"true\", 'say \"x\"']\n");
  std::vector<std::string> yaml;
  for (const DesignPoint& point : campaign.points) yaml.push_back(point.front().yaml);
  EXPECT_THAT(
      yaml, ElementsAre("[1 m, 2 m]", "{b: [c, \"d: e\"]}", "~", "\"true\"", "\"say \\\"x\\\"\""));
  EXPECT_EQ(campaign.points[4].front().text, "say \"x\"");
}

TEST(CampaignFile, AListNamesItsPointsOneByOne) {
  const CampaignFile campaign = read("points:\n  - {a.b: 1}\n  - {a.b: 2, c.d: x}\n");
  EXPECT_THAT(labels(campaign), ElementsAre("b=1", "b=2, d=x"));
  const FactorTable table = factor_table(campaign.keys, campaign.points);
  EXPECT_EQ(table.points[0].levels[1].text, "");
  EXPECT_EQ(table.points[1].levels[0].number, 2.0);
}

TEST(CampaignFile, APointThatLeavesAKeyAtItsDefaultShowsThat) {
  const CampaignFile campaign =
      read("points:\n  - {a.b: 1 m}\n  - {c.d: x}\n  - {a.b: 2 m, c.d: y, e.f: 1}\n");
  FactorTable table = factor_table(campaign.keys, campaign.points);
  const PointRow before = table.points[1];
  set_defaults(table, {{"", "z", "0"}, {"50 cm", "", ""}, {}});
  EXPECT_EQ(table.points[0].label, "b=1 m, d=z, f=0");
  EXPECT_EQ(table.points[1].label, "b=50 cm, d=x") << "it has no e.f";
  EXPECT_EQ(table.points[1].levels[0], (Level{"50 cm", 0.5, true}));
  EXPECT_EQ(table.points[1].levels[2], (Level{"", std::nullopt, true}));
  EXPECT_EQ(table.points[2].levels[0], (Level{"2 m", 2.0, false}));
  EXPECT_EQ(table.factors[0].unit, "m");
  // Seeds are named after what the file sets, whatever the default is.
  EXPECT_EQ(seed_of(Seeds::kIndependent, 7, table.points[1], 3),
            seed_of(Seeds::kIndependent, 7, before, 3));
}

TEST(CampaignFile, MistakesStandWhereTheyAreMade) {
  EXPECT_THAT(mistakes("vary: {a.b: 3}\n"),
              ElementsAre(testing::StartsWith("3:13: vary.a.b: must be a list of values")));
  EXPECT_THAT(mistakes("vary: {a.b: []}\n"),
              ElementsAre(testing::StartsWith("3:13: vary.a.b: must be a list of values")));
  EXPECT_THAT(mistakes("vary: {a.b: [1, 1]}\n"), ElementsAre("3:13: vary.a.b: has 1 twice"));
  EXPECT_THAT(mistakes("vary: {a.b: [5, \"5\"]}\n"), ElementsAre("3:13: vary.a.b: has 5 twice"));
  EXPECT_THAT(mistakes("points: [{a: 1}, {a: \"1\"}]\n"),
              ElementsAre(testing::HasSubstr("is the same as point 1")));
  EXPECT_THAT(mistakes("vary: {seed: [1, 2]}\n"),
              ElementsAre(testing::StartsWith("3:14: vary.seed: is not varied")));
  EXPECT_THAT(mistakes("vary: {a..b: [1]}\n"),
              ElementsAre("3:14: vary.a..b: 'a..b' is not the dotted path of a key"));
  EXPECT_THAT(mistakes("points: [{a: 1}, {a: 1}]\n"),
              ElementsAre(testing::HasSubstr("is the same as point 1")));
  EXPECT_THAT(mistakes("points: []\n"), ElementsAre("3:9: points: must have at least one"));
  EXPECT_THAT(mistakes("vary: {a: [1]}\npoints: [{a: 1}]\n"),
              ElementsAre(testing::HasSubstr("only one of `vary`, `points` and `sample`")));
  EXPECT_THAT(mistakes("replicatons: 3\n"),
              ElementsAre(testing::HasSubstr("did you mean 'replications'?")));
  EXPECT_THAT(mistakes("replications: 1000000\nvary: {a: [1, 2]}\n"),
              ElementsAre(testing::HasSubstr("more than the limit of 1000000 runs")));
  EXPECT_THAT(mistakes("name: a/b\n"), ElementsAre(testing::HasSubstr("letters, digits")));
  EXPECT_THAT(mistakes("keep: some\n"), ElementsAre(testing::HasSubstr("none, failed, all")));
}

TEST(CampaignFile, MistakesOfRangesStandThere) {
  const auto range = [](const std::string& text) {
    return mistakes("sample: {latin_hypercube: 4, ranges: {a.b: {" + text + "}}}\n");
  };
  EXPECT_THAT(range("from: 1 m, to: 2 s"), ElementsAre(testing::HasSubstr("unit like that")));
  EXPECT_THAT(range("from: 1 m, to: 2"), ElementsAre(testing::HasSubstr("unit like that")));
  EXPECT_THAT(range("from: 2 m, to: 150 cm"),
              ElementsAre(testing::HasSubstr("greater than `from`")));
  EXPECT_THAT(range("from: 0, to: 1, scale: log"),
              ElementsAre(testing::HasSubstr("greater than 0")));
  EXPECT_THAT(range("from: x, to: 1"), ElementsAre(testing::HasSubstr("must be a number")));
  EXPECT_THAT(range("from: 1, to: 2, whole: true, scale: log"),
              ElementsAre(testing::HasSubstr("is not for `scale: log`")));
  EXPECT_THAT(range("from: 1.2 s, to: 1.8 s, whole: true"),
              ElementsAre(testing::HasSubstr("no whole number between `from` and `to`")));
  EXPECT_THAT(range("from: 1.2 s, to: 2.8 s, whole: true"), ElementsAre());
  EXPECT_THAT(mistakes("sample: {latin_hypercube: 1, ranges: {a: [x]}}\n"),
              ElementsAre(testing::HasSubstr("below the limit of 2")));
  EXPECT_THAT(mistakes("sample: {latin_hypercube: 2}\n"),
              ElementsAre(testing::HasSubstr("must have keys")));
}

// Each of the parts of each range is taken once: so in linear and logarithmic measure, and so that
// lists give each value equally often.
TEST(LatinHypercube, TakesEachPartOfEachRangeOnce) {
  const CampaignFile campaign = read(R"(sample:
  latin_hypercube: 12
  ranges:
    a.length: {from: 10 cm, to: 0.5 m}
    a.rate: {from: 1 kb/s, to: 1 Mb/s, scale: log}
    a.count: {from: 3, to: 6, whole: true}
    a.kind: [x, y, z]
)");
  const auto points = points_of(campaign, 1);
  const FactorTable table = factor_table(campaign.keys, points);
  std::set<int> lengths, rates;
  std::map<std::string, int> counts, kinds;
  for (const PointRow& point : table.points) {
    const double length = *point.levels[0].number, rate = *point.levels[1].number;
    lengths.insert(static_cast<int>((length - 0.1) / 0.4 * 12));
    rates.insert(static_cast<int>(std::log10(rate / 1e3) / 3 * 12));
    ++counts[point.levels[2].text];
    ++kinds[point.levels[3].text];
  }
  EXPECT_EQ(lengths.size(), 12U);
  EXPECT_EQ(rates.size(), 12U);
  EXPECT_EQ(counts, (std::map<std::string, int>{{"3", 3}, {"4", 3}, {"5", 3}, {"6", 3}}));
  EXPECT_EQ(kinds, (std::map<std::string, int>{{"x", 4}, {"y", 4}, {"z", 4}}));
  EXPECT_EQ(table.factors[0].unit, "m");
  EXPECT_EQ(table.factors[2].unit, "");
}

TEST(LatinHypercube, RefusesPointsThatAreTheSame) {
  const auto count = [](int samples, const std::string& kinds) -> std::string {
    const CampaignFile campaign = read(
        fmt::format("sample: {{latin_hypercube: {}, ranges: {{a.kind: [{}]}}}}\n", samples, kinds));
    try {
      return std::to_string(points_of(campaign, 1).size());
    } catch (const hal::files::config::ConfigErrors& errors) {
      return errors.what();
    }
  };
  EXPECT_EQ(count(2, "x, y"), "2");
  EXPECT_THAT(count(4, "x, y"), testing::ContainsRegex("3:[0-9]+: sample: point [2-4] is the same "
                                                       "as point [12]: fewer points, or finer "
                                                       "ranges"));
  EXPECT_THAT(count(2, "5, \"5\""), testing::HasSubstr("point 2 is the same as point 1"));
}

TEST(LatinHypercube, FollowsFromTheSeedAndARangeFromItsKeyAlone) {
  const std::string one = "sample:\n  latin_hypercube: 5\n  ranges:\n    a: {from: 0, to: 1}\n";
  const auto texts = [](const CampaignFile& campaign, std::uint64_t seed) {
    std::vector<std::string> all;
    for (const DesignPoint& point : points_of(campaign, seed)) all.push_back(point.front().text);
    return all;
  };
  const auto first = texts(read(one), 1);
  EXPECT_EQ(texts(read(one), 1), first);
  EXPECT_NE(texts(read(one), 2), first);
  EXPECT_EQ(texts(read(one + "    b: {from: 0, to: 1}\n"), 1), first);
}

TEST(Factors, HaveOneUnitThatTheirNumbersAreIn) {
  const auto factor = [](const std::string& values) {
    const CampaignFile campaign = read("vary: {a.b: [" + values + "]}\n");
    return factor_table(campaign.keys, campaign.points);
  };
  EXPECT_EQ(factor("1 m, 20 cm").factors[0].unit, "m");
  EXPECT_EQ(factor("1 m, 20 cm").points[1].levels[0].number, 0.2);
  EXPECT_EQ(factor("0 dBm, 10 dBm").factors[0].unit, "dBm");
  EXPECT_EQ(factor("0 dBm, 10 dBm").points[1].levels[0].number, 10.0);
  EXPECT_EQ(factor("0 dBm, 2 mW").factors[0].unit, "W");
  EXPECT_EQ(factor("0 dBm, 2 mW").points[0].levels[0].number, 1e-3);
  EXPECT_EQ(factor("1 s, never").points[1].levels[0].number, std::nullopt);
  EXPECT_EQ(factor("1 s, 1 m").points[0].levels[0].number, std::nullopt);
}

TEST(Seeds, AreTheSameAtEachPointOrAllDifferent) {
  const CampaignFile campaign = read("vary: {a.b: [1, 2, 3]}\n");
  const FactorTable table = factor_table(campaign.keys, campaign.points);
  std::set<std::uint64_t> independent;
  for (const PointRow& point : table.points) {
    for (int k = 1; k <= 4; ++k) {
      EXPECT_EQ(seed_of(Seeds::kCommon, 7, point, k), 6U + static_cast<unsigned>(k));
      independent.insert(seed_of(Seeds::kIndependent, 7, point, k));
    }
  }
  EXPECT_EQ(independent.size(), 12U);
  EXPECT_LE(*independent.rbegin(), 9223372036854775807U);  // as the scenario's key allows
  PointRow moved = table.points[1];
  moved.point = 9;  // more points before it
  EXPECT_EQ(seed_of(Seeds::kIndependent, 7, moved, 2),
            seed_of(Seeds::kIndependent, 7, table.points[1], 2));
}

}  // namespace
}  // namespace results::campaign
