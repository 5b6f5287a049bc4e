#include "baraka/run/output/finished_result.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "gateway/process/exit_status.h"
#include "tests/unit/results/record/test_run.h"

namespace baraka::run::output {
namespace {

namespace fs = std::filesystem;

class FinishedResultTest : public testing::Test {
 protected:
  FinishedResultTest()
      : folder_(fs::temp_directory_path() /
                ("baraka_finished_result_" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    std::ofstream(folder_ / "scenario.resolved.yaml")
        << "version: 1\nreport:\n  - plot: delay\nseed: 3\n";
    results::record::test::make_result(folder_, "INSERT INTO settings VALUES ('--until', '60 s')");
  }
  ~FinishedResultTest() override { fs::remove_all(folder_); }

  std::string judged(const std::string& resolved, const std::string& until) const {
    try {
      require_result_of(folder_, resolved, until);
    } catch (const gateway::process::UsageError& e) {
      return e.what();
    }
    return "accepted";
  }

  const fs::path folder_;
};

TEST_F(FinishedResultTest, TakesTheResultOfTheSameRunOnly) {
  EXPECT_EQ(judged("version: 1\nseed: 3\n", "60 s"), "accepted");  // no report is no other run
  const std::string other = judged("version: 1\nreport: []\nseed: 4\n", "60 s");
  EXPECT_NE(other.find("another run: there 'seed: 3', now 'seed: 4'"), std::string::npos) << other;
  const std::string longer = judged("version: 1\nseed: 3\n", "its end");
  EXPECT_NE(longer.find("--until: there '60 s', now 'its end'"), std::string::npos) << longer;
}

}  // namespace
}  // namespace baraka::run::output
