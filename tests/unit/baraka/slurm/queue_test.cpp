#include "baraka/slurm/queue.h"

#include <gtest/gtest.h>

namespace baraka::slurm {
namespace {

// What Slurm 22.05.8 printed, of an array of which one task waits, one runs and one is held.
constexpr const char* kQueue =
    "7|4|PENDING|baraka-0f3a-1|Nodes required for job are DOWN, DRAINED|or reserved\n"
    "7|0|RUNNING|baraka-0f3a-1|None\n"
    "9|1|PENDING|baraka-0f3a-2|JobHeldUser\n";

TEST(SlurmQueue, EachLineIsATask) {
  const auto tasks = parse_queue(kQueue);
  ASSERT_TRUE(tasks);
  ASSERT_EQ(tasks->size(), 3U);
  EXPECT_EQ((*tasks)[0].job, 7);
  EXPECT_EQ((*tasks)[0].index, 4);
  EXPECT_TRUE((*tasks)[0].is_waiting());
  EXPECT_EQ((*tasks)[0].reason, "Nodes required for job are DOWN, DRAINED|or reserved");
  EXPECT_EQ((*tasks)[1].state, "RUNNING");
  EXPECT_FALSE((*tasks)[1].is_waiting());
  EXPECT_EQ((*tasks)[2].name, "baraka-0f3a-2");
}

TEST(SlurmQueue, AnEmptyQueueHasNoTasks) {
  const auto tasks = parse_queue("");
  ASSERT_TRUE(tasks);
  EXPECT_TRUE(tasks->empty());
}

TEST(SlurmQueue, WhatIsNoTaskIsAnErrorThatShowsTheLine) {
  for (const char* line : {"slurm_load_jobs error: Unable to contact slurm controller",
                           "7|[0-4]|PENDING|name|None", "7||RUNNING|name|None", "7|1||name|None"}) {
    const auto tasks = parse_queue(line);
    ASSERT_FALSE(tasks) << line;
    EXPECT_NE(tasks.error().message.find(line), std::string::npos);
  }
}

TEST(SlurmJob, TheEndOfATaskIsReadFromItsKeys) {
  const auto end = parse_job(
      "JobId=12 ArrayJobId=11 ArrayTaskId=3 JobName=baraka UserId=root(0) JobState=TIMEOUT "
      "Reason=TimeLimit Dependency=(null) Requeue=1 Restarts=2 ExitCode=0:15 "
      "RunTime=1-00:01:05 TimeLimit=1-00:01:00 "
      "ReqNodeList=(null) ExcNodeList=(null) NodeList=n2 BatchHost=n2\n");
  ASSERT_TRUE(end);
  EXPECT_EQ(end->state, "TIMEOUT");
  EXPECT_EQ(end->status, 0);
  EXPECT_EQ(end->signal, 15);
  EXPECT_EQ(end->restarts, 2);
  EXPECT_EQ(end->wall_s, 86465);
  EXPECT_FALSE(end->has_status(0));
  EXPECT_EQ(end->in_words(), "TIMEOUT on n2 (TimeLimit), killed by signal 15");
}

TEST(SlurmJob, AnExitStatusIsSaidOnce) {
  const auto end =
      parse_job("JobId=3 JobState=FAILED Reason=NonZeroExitCode ExitCode=2:0 NodeList=(null)\n");
  ASSERT_TRUE(end);
  EXPECT_TRUE(end->has_status(2));
  EXPECT_FALSE(end->wall_s);
  EXPECT_EQ(end->in_words(), "FAILED, exit status 2");
}

TEST(SlurmJob, WhatSaysNothingOfAStateIsNone) {
  EXPECT_FALSE(parse_job("slurm_load_jobs error: Invalid job id specified\n"));
}

TEST(SlurmConfig, AKeyIsFoundByItsWholeName) {
  constexpr const char* kPrinted =
      "MaxArraySize            = 1001\nMaxJobCount             = 10000\n";
  EXPECT_EQ(parse_config(kPrinted, "MaxArraySize"), "1001");
  EXPECT_EQ(parse_config(kPrinted, "MaxJobCount"), "10000");
  EXPECT_FALSE(parse_config(kPrinted, "MaxArray"));
}

TEST(SlurmProcessors, ThoseOfNodesThatAreDownDoNotCount) {
  EXPECT_EQ(parse_processors("1/3/2/6\n"), 4);
  EXPECT_FALSE(parse_processors(""));
  EXPECT_FALSE(parse_processors("1K/3K/0/4K\n"));
}

TEST(SlurmSubmission, TheNumberStandsInALineOfItsOwn) {
  EXPECT_EQ(parse_submission("17\n"), 17);
  EXPECT_EQ(parse_submission("welcome to the cluster\n18;dragon\n"), 18);
  EXPECT_FALSE(parse_submission("sbatch: error: 5\n"));
}

}  // namespace
}  // namespace baraka::slurm
