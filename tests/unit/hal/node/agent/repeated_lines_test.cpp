#include "hal/node/agent/repeated_lines.h"

#include <gtest/gtest.h>

#include <chrono>

namespace hal::node::agent {
namespace {

using namespace std::chrono_literals;

TEST(RepeatedLines, AreSaidAtOnceAndThenEveryFiveSecondsWithTheirCount) {
  RepeatedLines lines;
  EXPECT_EQ(lines.take(Time{1s}, "no"), "no");
  EXPECT_EQ(lines.take(Time{1s}, "never"), "never");
  EXPECT_EQ(lines.take(Time{2s}, "no"), std::nullopt);
  EXPECT_EQ(lines.take(Time{5s}, "no"), std::nullopt);
  EXPECT_EQ(lines.take(Time{6s}, "no"), "no (2 times more meanwhile)");
  EXPECT_EQ(lines.take(Time{11s}, "no"), "no");
}

}  // namespace
}  // namespace hal::node::agent
