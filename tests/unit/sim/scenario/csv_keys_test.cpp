// Keys that name CSV files: antenna patterns and measured losses.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "hal/files/config/errors.h"
#include "sim/scenario/resolved.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {
namespace {

namespace fs = std::filesystem;

class CsvKeys : public testing::Test {
 protected:
  CsvKeys()
      : folder_(fs::path(testing::TempDir()) /
                testing::UnitTest::GetInstance()->current_test_info()->name()) {
    fs::create_directories(folder_);
  }
  ~CsvKeys() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  /// A scenario of the stations a, b and c with these keys in its radio, on line 2.
  Scenario load(const std::string& radio, const std::string& own = "") const {
    const auto station = [&](const std::string& name) {
      return "  " + name + ": {name: " + name + ", station: {}, poses: [{x: 0 m, y: 0 m}]" +
             (name == "a" ? own : "") + "}\n";
    };
    return load_scenario(write("s.yaml", "version: 1\nradio: {profile: ieee80211b, " + radio +
                                             "}\nagents:\n" + station("a") + station("b") +
                                             station("c") + "end: [{at: 1 s, result: done}]\n"));
  }
  std::string mistakes_of(const std::string& radio) const {
    try {
      load(radio);
    } catch (const hal::files::config::ConfigErrors& errors) {
      std::string text = errors.what();
      for (std::size_t at; (at = text.find(folder_.string() + "/")) != std::string::npos;)
        text.erase(at, folder_.string().size() + 1);
      return text;
    }
    return "none";
  }
  std::string mistakes_of_pattern(const std::string& csv) const {
    write("t.csv", csv);
    return mistakes_of("antenna: {pattern: table, file: t.csv}");
  }
  std::string mistakes_of_links(const std::string& csv, const std::string& more = "") const {
    write("t.csv", csv);
    return mistakes_of("propagation: [{model: measured, file: t.csv" + more + "}]");
  }
  static void expect_in(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text << "\nlacks\n" << part;
  }

  fs::path folder_;
};

const radio::PropagationConfig& air_of(const Scenario& scenario) {
  return waves_of(scenario.simulation.radio)->propagation;
}
const radio::MeasuredConfig& links_of(const Scenario& scenario) {
  return std::get<radio::MeasuredConfig>(air_of(scenario).chain.at(0));
}

const std::string kPattern = "azimuth_deg,elevation_deg,gain_dbi\n";

TEST_F(CsvKeys, ReadThePatternsOfAntennas) {
  write("t.csv", "# measured\r\n" + kPattern + "\n0, 0, 2\r\n180,0,-10.5\n");
  const Scenario scenario =
      load("antenna: {pattern: table, file: t.csv}", ", radio: {antenna: {pattern: dipole}}");
  const auto& table = std::get<radio::TableAntenna>(air_of(scenario).antenna);
  EXPECT_EQ(table.rows, (std::vector<radio::AntennaRow>{{0, 0, 2}, {180, 0, -10.5}}));
  const auto& agents = scenario.simulation.agents;
  EXPECT_EQ(agents[0].radio.antenna, radio::AntennaConfig{radio::DipoleAntenna{}});
  EXPECT_FALSE(agents[1].radio.antenna.has_value());
}

TEST_F(CsvKeys, FindTheSharedTableOfADipole) {
  const Scenario scenario =
      load("antenna: {pattern: table, file: " CONFIG_DIR "/antennas/half_wave_dipole.csv}");
  const radio::AntennaPattern table(air_of(scenario).antenna), closed(radio::DipoleAntenna{});
  for (const double up : {0.0, 0.2, 0.5, 1.0}) {
    const hal::Vec3 way{0.6, 0.8, up};
    // A ratio: rows 5 degrees apart are 0.1 dB off between them.
    EXPECT_NEAR(table.towards(way) / closed.towards(way), 1, 0.02) << up;
  }
}

TEST_F(CsvKeys, KeepPatternsInTheResolvedScenario) {
  write("t.csv", kPattern + "0,0,2.123456789\n180,0,-10.5\n");
  const Scenario scenario = load("antenna: {pattern: table, file: t.csv}",
                                 ", radio: {antenna: {pattern: beam, width: 30 deg, back: 9 dB}}");
  fs::remove(folder_ / "t.csv");
  const std::string resolved = resolved_yaml(scenario);
  const Scenario again = load_scenario(write("again.yaml", resolved));
  EXPECT_EQ(air_of(again).antenna, air_of(scenario).antenna);
  EXPECT_EQ(again.simulation.agents[0].radio, scenario.simulation.agents[0].radio);
  EXPECT_EQ(resolved_yaml(again), resolved);
}

TEST_F(CsvKeys, SayWhatIsWrongWithAPatternAndWhere) {
  expect_in(mistakes_of_pattern(kPattern + "0,0,2\n  90, 0x, 1\n"),
            "t.csv:3:7: elevation_deg: '0x' is not a number from -90 to 90");
  expect_in(mistakes_of_pattern(kPattern + "0,0,2\n0,0,3\n"),
            "t.csv:3:1: this direction is there already");
  expect_in(mistakes_of_pattern(kPattern + "0,0,2\n90,0,3\n0,10,1\n"),
            "t.csv:4:1: not every elevation has every azimuth");
  expect_in(mistakes_of_pattern(kPattern + "0,0\n"),
            "t.csv:2:1: has 2 values; needed are azimuth_deg,elevation_deg,gain_dbi");
  expect_in(mistakes_of_pattern("a,b\n1,2\n"), "the header is 'a,b'");
  expect_in(mistakes_of_pattern(kPattern), "has no rows");
  expect_in(mistakes_of("antenna: {pattern: table, file: none.csv}"),
            "there is no file 'none.csv'");
  expect_in(mistakes_of("antenna: {pattern: table}"), "table needs `file` or `rows`");
}

TEST_F(CsvKeys, ReadLossesAndReceivedPowers) {
  write("t.csv", "from,to,loss_db\na,b,70\nb,c,80.25\n c , a ,90\n");
  const Scenario matrix = load("propagation: [{model: measured, file: t.csv}]");
  ASSERT_EQ(links_of(matrix).rows->size(), 3u);
  EXPECT_EQ(links_of(matrix).rows->at(2).from, "c");
  EXPECT_EQ(links_of(matrix).rows->at(1).loss, 80.25);
  EXPECT_FALSE(links_of(matrix).has_times);
  write("t.csv", "from,to,time_s,rssi_dbm\na,b,0,-60\na,b,1.5,-61\n");
  const Scenario trace = load(
      "propagation: [{model: measured, file: t.csv, tx_power: 16 dBm, between: linear, silence: "
      "0.5 s, "
      "otherwise: {model: log_distance, exponent: 2.5}}]");
  EXPECT_TRUE(links_of(trace).has_times);
  EXPECT_EQ(links_of(trace).rows->at(1).at, 1.5);
  EXPECT_EQ(links_of(trace).rows->at(1).loss, 77);
  EXPECT_EQ(links_of(trace).between, radio::MeasuredBetween::kLinear);
  EXPECT_EQ(links_of(trace).silence, hal::Duration{std::chrono::milliseconds{500}});
  EXPECT_EQ(std::get<radio::LogDistanceConfig>(*links_of(trace).otherwise).exponent, 2.5);
}

TEST_F(CsvKeys, KeepLossesInTheResolvedScenario) {
  for (const std::string header : {"from,to,loss_db\n", "from,to,time_s,loss_db\n"}) {
    const std::string time = header.find("time") == std::string::npos ? "" : "0.125,";
    write("t.csv", header + "a,b," + time + "70.0625\na,c," + time + "80\nb,c," + time + "90\n");
    const Scenario scenario = load("propagation: [{model: measured, file: t.csv}]");
    fs::remove(folder_ / "t.csv");
    const std::string resolved = resolved_yaml(scenario);
    const Scenario again = load_scenario(write("again.yaml", resolved));
    ASSERT_EQ(links_of(again).rows->size(), 3u) << resolved;
    EXPECT_EQ(links_of(again).rows->at(0).loss, 70.0625);
    EXPECT_EQ(links_of(again).rows->at(0).at, time.empty() ? 0 : 0.125);
    EXPECT_EQ(links_of(again).has_times, links_of(scenario).has_times);
    EXPECT_EQ(resolved_yaml(again), resolved) << "with other losses it is another scenario";
  }
}

TEST_F(CsvKeys, SayWhatIsWrongWithLossesAndWhere) {
  const std::string header = "from,to,loss_db\n";
  expect_in(mistakes_of_links(header + "a,b,70\na,c,80\n"),
            "there is no loss for 'b' and 'c', and no `otherwise`");
  expect_in(mistakes_of_links(header + "a,b,70\na,c,8O\nb,c,1\n"),
            "t.csv:3:5: loss_db: '8O' is not a number from 0 to 300");
  expect_in(mistakes_of_links(header + "a,b,70\na,b,80\n"),
            "t.csv:3:1: this link and time are there already");
  expect_in(mistakes_of_links(header + "a,a,70\n"), "t.csv:2:1: from and to are the same");
  expect_in(mistakes_of_links(header + "a,d,70\n"), "t.csv:2:1: there is no agent 'd'");
  expect_in(mistakes_of_links("from,to\na,b\n"), "the header is 'from,to'");
  expect_in(mistakes_of_links("from,to,rssi_dbm\na,b,-60\n"), "is needed for received power");
  expect_in(mistakes_of_links("from,to,rssi_dbm\na,b,17\n", ", tx_power: 16 dBm"),
            "t.csv:2:5: rssi_dbm: '17' is not a number from -200 to 16");
  expect_in(mistakes_of_links(header + "a,b,70\n", ", tx_power: 16 dBm"), "there are losses");
  expect_in(mistakes_of("propagation: [{model: measured}]"), "measured needs `file` or `rows`");
  expect_in(mistakes_of("propagation: [{model: measured, rows: ['a,b,-1']}]"),
            "row 1: loss_db: '-1' is not a number");
}

}  // namespace
}  // namespace sim::scenario
