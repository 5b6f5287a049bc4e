#include "baraka/campaign/campaign_loop.h"

#include <gtest/gtest.h>

#include "results/campaign/campaign_reader.h"
#include "tests/unit/results/record/test_run.h"

namespace baraka::campaign {
namespace {

using results::campaign::RunState;

/// Every run ends at once, with a result by hand; the second has two agents of one name.
class EngineOfResults final : public Engine {
 public:
  std::string_view name() const override { return "by hand"; }
  std::vector<std::int64_t> adopt(std::span<const CampaignTask>) override { return {}; }
  std::size_t room() const override { return 1; }
  std::size_t running() const override { return ends_.size(); }
  std::size_t slots() const override { return 1; }
  void stop() override {}
  std::vector<TaskEnd> poll(hal::Duration) override { return std::exchange(ends_, {}); }

  void start(std::span<const CampaignTask> tasks) override {
    for (const CampaignTask& task : tasks) {
      const std::string number = std::to_string(task.run);
      const std::string twin = task.run == 2 ? "m0" : "m1";
      results::record::test::make_result(
          task.folder,
          "INSERT INTO run VALUES ('exit_status', 0), ('result', 'until'), ('seed', '" + number +
              "');"
              "INSERT INTO agents VALUES (1, 'm0', 'mote', 'p', 0, 0, 0), (2, '" +
              twin +
              "', 'mote', 'p', 1, 0, 0);"
              "INSERT INTO agent_use VALUES (1, 1, 2, 7, 0, 5, NULL, NULL),"
              " (2, 0, 5, 5, 0, 2, NULL, NULL);");
      ends_.push_back({.run = task.run,
                       .cause = "exited with status 0",
                       .host = "here",
                       .wall_s = {},
                       .user_s = {}});
    }
  }

 private:
  std::vector<TaskEnd> ends_;
};

TEST(CampaignLoop, GoesOnAfterARunThatTheDatabaseDoesNotTake) {
  const results::record::test::Folder parent("campaign_loop");
  const CampaignFolder folder(parent.path() / "campaign", {});
  results::campaign::CampaignDatabase database(folder.path());
  database.add({.values = {{"name", "twins"}},
                .factors = {},
                .points = {{1, "", "version: 1\n", {}}},
                .runs = {{1, 1, 1, 1}, {2, 1, 2, 2}, {3, 1, 3, 3}}});
  EngineOfResults engine;
  CampaignLoop loop({database, folder, engine}, {.keep = results::campaign::Keep::kFailed,
                                                 .retry_failed = false,
                                                 .replications = 3,
                                                 .results_are_folders = false,
                                                 .run_arguments = {},
                                                 .progress = {}});
  loop.run();
  const auto runs = results::campaign::CampaignReader(folder.path()).runs();
  ASSERT_EQ(runs.size(), 3u);
  EXPECT_EQ(runs[0].state, RunState::kDone);
  EXPECT_EQ(runs[1].state, RunState::kFailed);
  EXPECT_NE(runs[1].error.find("UNIQUE"), std::string::npos) << runs[1].error;
  EXPECT_FALSE(runs[1].folder.empty()) << "kept, as of runs that fail";
  EXPECT_EQ(runs[2].state, RunState::kDone);
}

}  // namespace
}  // namespace baraka::campaign
