#include <gtest/gtest.h>

#include "results/report/report_sections.h"

namespace results::report {
namespace {

RunResult run_with(std::uint64_t frames, std::uint64_t most, std::int64_t waited_ns) {
  RunResult run;
  run.agents = {{.agent = 1, .name = "ap"}, {.agent = 2, .name = "r0"}};
  run.queues = {{.agent = 1,
                 .receiver = 2,
                 .category = "BE",
                 .frames = frames,
                 .waiting = 1,
                 .most = most,
                 .most_bytes = 100 * most,
                 .waited_ns = waited_ns,
                 .drops = {{"queue full", 3}, {"queue delay", 2}, {"radio off", 1}}}};
  return run;
}

// Frames and drops add up, the longest queue is that of one run, and the mean is over all frames.
TEST(ReportQueues, AddsUpTheRunsOfAGroup) {
  RunResult one = run_with(10, 4, 30'000'000), other = run_with(30, 5, 10'000'000);
  other.queues.push_back(
      {.agent = 1, .receiver = 65535, .category = "VO", .drops = {{"expired", 7}}});
  Group group;
  group.name = "g";
  group.runs = {&one, &other};
  EXPECT_EQ(queues_section(group),
            "g: queues for receivers and access categories, total of 2 runs\n"
            "agent        to  category  frames  mean wait ms  most at once  most bytes  waiting  "
            "queue full  queue delay  expired  other\n"
            "ap           r0        BE      40         1.000             5         500        2  "
            "         6            4        0      2\n"
            "ap     everyone        VO       0             -             0           0        0  "
            "         0            0        7      0\n");
}

TEST(ReportQueues, SaysNothingWhereThereAreNone) {
  RunResult run;
  Group group;
  group.runs = {&run};
  EXPECT_EQ(queues_section(group), "");
}

}  // namespace
}  // namespace results::report
