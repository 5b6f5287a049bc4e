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
using radio::ErrorTable;
using radio::ModulationClass;

class ErrorTableKey : public testing::Test {
 protected:
  ErrorTableKey()
      : folder_(fs::path(testing::TempDir()) /
                testing::UnitTest::GetInstance()->current_test_info()->name()) {
    fs::create_directories(folder_ / "tables");
  }
  ~ErrorTableKey() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  /// A scenario with this value of the key, on line 2.
  Scenario load(const std::string& value) const {
    return load_scenario(
        write("s.yaml", "version: 1\nradio: {profile: ieee80211n, error_table: " + value +
                            "}\n"
                            "agents: {m: {station: {}, poses: [{x: 0 m, y: 0 m}]}}\n"
                            "end: [{at: 1 s, result: done}]\n"));
  }
  std::string mistakes_of(const std::string& csv) const {
    write("tables/t.csv", csv);
    try {
      load("tables/t.csv");
    } catch (const hal::files::config::ConfigErrors& errors) {
      std::string text = errors.what();
      for (std::size_t at; (at = text.find(folder_.string() + "/")) != std::string::npos;) {
        text.erase(at, folder_.string().size() + 1);
      }
      return text;
    }
    return "none";
  }

  fs::path folder_;
};

const ErrorTable& table_of(const Scenario& scenario) {
  return ofdm_of(scenario.simulation.radio)->error_table;
}

const std::string kHeader = "mode,size,snr_db,per\n";

TEST_F(ErrorTableKey, ReadsAFileBesideTheScenario) {
  write("tables/t.csv", "# measured\r\n" + kHeader + "\nHT7, 1458, 18.5, 1\r\nHT7,1458,22,1e-3\n" +
                            "OFDM54,32,-1,1\nOFDM54,32,3,0\n");
  EXPECT_EQ(table_of(load("tables/t.csv")), (ErrorTable{{ModulationClass::kHt, 7, 1458, 18.5, 1},
                                                        {ModulationClass::kHt, 7, 1458, 22, 1e-3},
                                                        {ModulationClass::kOfdm, 7, 32, -1, 1},
                                                        {ModulationClass::kOfdm, 7, 32, 3, 0}}));
}

TEST_F(ErrorTableKey, KeepsTheRowsInTheResolvedScenario) {
  write("tables/t.csv", kHeader + "HT7,1458,18.1,0.1234567890123\nHT7,1458,22,1e-3\n");
  const Scenario scenario = load("tables/t.csv");
  fs::remove(folder_ / "tables/t.csv");
  const std::string resolved = resolved_yaml(scenario);
  EXPECT_EQ(table_of(load_scenario(write("again.yaml", resolved))), table_of(scenario));
  EXPECT_EQ(resolved_yaml(load_scenario(folder_ / "again.yaml")), resolved);
  EXPECT_EQ(resolved.find("t.csv"), std::string::npos) << "the content counts, not the name";
}

TEST_F(ErrorTableKey, FindsATableBesideAnIncludedFile) {
  write("tables/t.csv", kHeader + "HT7,1458,18,1\nHT7,1458,22,0\n");
  write("tables/radio.yaml", "profile: ieee80211n\nerror_table: t.csv\n");
  const fs::path file = write("i.yaml",
                              "version: 1\nradio: {include: tables/radio.yaml}\n"
                              "agents: {m: {station: {}, poses: [{x: 0 m, y: 0 m}]}}\n"
                              "end: [{at: 1 s, result: done}]\n");
  EXPECT_EQ(table_of(load_scenario(file)).size(), 2u);
}

TEST_F(ErrorTableKey, TellsMistakesWithTheirLines) {
  const std::string at = "s.yaml:2:43: radio.error_table: ";
  const auto in_table = [&](int line, const std::string& what) {
    return at + "tables/t.csv:" + std::to_string(line) + ": " + what;
  };
  const std::string good = "HT7,1458,18,1\nHT7,1458,22,0\n";
  EXPECT_EQ(mistakes_of(kHeader + good), "none");
  EXPECT_EQ(mistakes_of(good), in_table(1,
                                        "'HT7,1458,18,1' is not the header, "
                                        "mode,size,snr_db,per"));
  EXPECT_EQ(mistakes_of(kHeader), at + "'tables/t.csv' has no rows");
  EXPECT_EQ(mistakes_of(kHeader + good + "HT77,1,1,0\n"),
            in_table(4, "mode: 'HT77' is unknown; did you mean 'HT7'?"));
  EXPECT_EQ(mistakes_of(kHeader + good + "HT6,0,1,0\n"),
            in_table(4, "size: '0' is not a number from 1 to 1000000"));
  EXPECT_EQ(mistakes_of(kHeader + good + "HT6,10,nan,0\n"),
            in_table(4, "snr_db: 'nan' is not a number from -100 to 100"));
  EXPECT_EQ(mistakes_of(kHeader + good + "HT6,10,1,1.1\n"),
            in_table(4, "per: '1.1' is not a number from 0 to 1"));
  EXPECT_EQ(mistakes_of(kHeader + good + "HT6,10,1\n"),
            in_table(4, "has 3 values; needed are mode,size,snr_db,per"));
  EXPECT_EQ(mistakes_of(kHeader + "\n" + good + "HT7,1458,21,0\n"),
            in_table(5, "snr_db: 21 is not above that of the row before, 22"));
}

TEST_F(ErrorTableKey, NamesAFileThatIsNotThere) {
  try {
    load("tables/absent.csv");
    FAIL();
  } catch (const hal::files::config::ConfigErrors& errors) {
    EXPECT_NE(std::string(errors.what())
                  .find("there is no file '" + (folder_ / "tables/absent.csv").string() + "'"),
              std::string::npos)
        << errors.what();
  }
}

}  // namespace
}  // namespace sim::scenario
