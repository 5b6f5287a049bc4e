#include "baraka/slurm/array_job.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "baraka/slurm/program.h"

namespace baraka::slurm {
namespace {

using namespace std::chrono_literals;

ArrayJob job_of(const std::vector<int>& indices) {
  ArrayJob job{.name = "baraka-1", .program = "/usr/bin/printf", .folder = "/", .log = "/l%g.log"};
  for (const int index : indices) {
    job.tasks.push_back(
        {index, {"[%s] ", "it's", std::to_string(index), "$HOME `x` \\ \""}, "/dev/stdout"});
  }
  return job;
}

/// What the script prints as the task of an index.
Printed run_as(const std::string& script, const std::string& index) {
  const auto printed =
      run_program({"env", "SLURM_ARRAY_TASK_ID=" + index, "bash", "-c", script}, 10s);
  return printed ? *printed : Printed{-1, "", printed.error().message};
}

TEST(SlurmArrayJob, IndicesInARowAreARange) {
  EXPECT_EQ(indices_of(job_of({3})), "3");
  EXPECT_EQ(indices_of(job_of({0, 1, 2, 4, 7, 8})), "0-2,4,7-8");
  ArrayJob job = job_of({1, 2});
  job.at_once = 5;
  EXPECT_EQ(indices_of(job), "1-2%5");
}

TEST(SlurmArrayJob, EachTaskBecomesItsProgramWithItsArgumentsAsTheyAre) {
  const std::string script = script_of(job_of({1, 20}));
  EXPECT_EQ(run_as(script, "20").out, "[it's] [20] [$HOME `x` \\ \"] ");
  EXPECT_EQ(run_as(script, "1").out, "[it's] [1] [$HOME `x` \\ \"] ");
}

TEST(SlurmArrayJob, WhatATaskPrintsIsAppendedToItsLogAndSoIsThatItCannotStart) {
  const std::filesystem::path log =
      testing::TempDir() + "/it's a log of " + std::to_string(::getpid());
  ArrayJob job{.name = "n", .program = "/bin/echo", .folder = "/", .log = "/l"};
  job.tasks = {{0, {"first"}, log}};
  (void)run_as(script_of(job), "0");
  job.program = "/not/there";
  EXPECT_EQ(run_as(script_of(job), "0").status, 127);
  std::ifstream in(log);
  std::string first, second;
  std::getline(in, first);
  std::getline(in, second);
  std::filesystem::remove(log);
  EXPECT_EQ(first, "first");
  EXPECT_NE(second.find("/not/there: No such file"), std::string::npos) << second;
}

TEST(SlurmArrayJob, AnIndexWithoutATaskIsAnError) {
  const Printed printed = run_as(script_of(job_of({1})), "2");
  EXPECT_EQ(printed.status, 2);
  EXPECT_EQ(printed.last_error(), "error: no task 2 in this job");
}

TEST(SlurmArrayJob, TheSubmissionSaysWhatTheSettingsSay) {
  const results::campaign::SlurmSettings settings{
      .partition = "short", .time = 90min + 500ms, .arguments = {"--mem=1G"}};
  const auto command = submission_of(job_of({0}), settings, "/s.sh");
  const auto has = [&](const std::string& word) {
    return std::ranges::find(command, word) != command.end();
  };
  EXPECT_TRUE(has("--partition=short"));
  EXPECT_TRUE(has("--time=0-01:30:01"));
  EXPECT_TRUE(has("--mem=1G"));
  EXPECT_TRUE(has("--requeue"));
  EXPECT_TRUE(has("--output=/l%%g.log"));
  EXPECT_EQ(command.back(), "/s.sh");
}

TEST(SlurmProgram, WhatIsNotThereIsNamed) {
  const auto printed = run_program({"no-such-program-of-slurm"}, 1s);
  ASSERT_FALSE(printed);
  EXPECT_EQ(printed.error().code, hal::Errc::kNotAvailable);
  EXPECT_NE(printed.error().message.find("no-such-program-of-slurm"), std::string::npos);
}

TEST(SlurmProgram, OneThatDoesNotEndIsKilledWithWhatItStarted) {
  const auto printed = run_program({"bash", "-c", "echo stuck >&2; sleep 1000; true"}, 200ms);
  ASSERT_FALSE(printed);
  EXPECT_EQ(printed.error().code, hal::Errc::kTimeout);
  EXPECT_NE(printed.error().message.find("stuck"), std::string::npos);
}

TEST(SlurmProgram, OneIsGivenUpByWhatItPrints) {
  const auto printed = run_program(
      {"bash", "-c", "echo sleeping and retrying >&2; sleep 1000"}, 100s,
      [](const Printed& so_far) { return so_far.err.find("retrying") != std::string::npos; });
  ASSERT_FALSE(printed);
  EXPECT_NE(printed.error().message.find("sleeping and retrying"), std::string::npos);
}

TEST(SlurmProgram, LongOutputAndErrorsArriveWhole) {
  const auto printed =
      run_program({"bash", "-c", "for i in {1..5000}; do echo $i; echo $i >&2; done; exit 3"}, 20s);
  ASSERT_TRUE(printed);
  EXPECT_EQ(printed->status, 3);
  EXPECT_EQ(std::ranges::count(printed->out, '\n'), 5000);
  EXPECT_EQ(printed->last_error(), "5000");
  EXPECT_EQ(printed->last_errors(), "4998; 4999; 5000");
}

}  // namespace
}  // namespace baraka::slurm
