#include "baraka/campaign/campaign_progress.h"

#include <gtest/gtest.h>

namespace baraka::campaign {
namespace {

using namespace std::chrono_literals;
using results::campaign::RunPlan;

constexpr CampaignProgress::Clock::time_point kBegin{1h};

std::vector<RunPlan> plans(int count) {
  std::vector<RunPlan> runs;
  for (int i = 1; i <= count; ++i) runs.push_back({i, 1, i, static_cast<std::uint64_t>(i)});
  return runs;
}

results::campaign::RunRow done(const RunPlan& run) {
  results::campaign::RunRow row;
  row.plan = run;
  row.state = results::campaign::RunState::kDone;
  row.wall_s = 10;
  return row;
}

/// What it says of all that were given to a queue, after the first four of them, of 10 s each.
class QueuedRuns : public testing::TestWithParam<std::size_t> {};

// All of them are given away at once, as to Slurm, and end two by two.
TEST_P(QueuedRuns, WaitForASlot) {
  const auto runs = plans(static_cast<int>(GetParam()));
  CampaignProgress progress({.terminal = true, .every_run = false, .slots = 2});
  progress.set_waiting(runs);
  for (const RunPlan& run : runs) progress.on_start(run, kBegin);
  for (std::size_t i = 0; i < 4; ++i) {
    progress.on_end(done(runs[i]), "", kBegin + (i < 2 ? 10s : 20s));
  }
  const double left = 10.0 * static_cast<double>(runs.size() - 4) / 2;
  EXPECT_DOUBLE_EQ(progress.left(kBegin + 20s)->seconds, left);
  EXPECT_DOUBLE_EQ(progress.left(kBegin + 24s)->seconds, left - 4);
  testing::internal::CaptureStderr();
  progress.show(kBegin + 24s, 1);
  const std::string line = testing::internal::GetCapturedStderr();
  EXPECT_NE(line.find("4 of " + std::to_string(runs.size())), std::string::npos) << line;
  EXPECT_NE(line.find("1 running, " + std::to_string(runs.size() - 5) + " queued"),
            std::string::npos)
      << line;
}

INSTANTIATE_TEST_SUITE_P(Counts, QueuedRuns, testing::Values(8, 100));

TEST(CampaignProgress, HasABarThatCannotBeMoreThanFull) {
  CampaignProgress progress({.terminal = true, .every_run = false, .slots = 2});
  progress.set_waiting(plans(2));
  for (const RunPlan& run : plans(6)) progress.on_end(done(run), "", kBegin);
  testing::internal::CaptureStderr();
  EXPECT_NO_THROW(progress.show(kBegin + 5s, 0));
  EXPECT_NE(testing::internal::GetCapturedStderr().find("[" + std::string(24, '#') + "]"),
            std::string::npos);
}

}  // namespace
}  // namespace baraka::campaign
