#include "hal/node/routing/memory.h"

#include <gtest/gtest.h>

namespace hal::node::routing {
namespace {

using namespace std::chrono_literals;

TEST(Memory, KnowsAKeyUntilItsSpanIsOver) {
  Memory<int, Seen> memory;
  EXPECT_TRUE(memory.note(1, Time{0s}).second);
  EXPECT_FALSE(memory.note(1, Time{60s}).second);
  EXPECT_TRUE(memory.note(1, Time{60s + 1ns}).second);
}

TEST(Memory, ForgetsTheOldestBeyondItsBound) {
  Memory<int, Seen> memory;
  const int most = static_cast<int>(Memory<int, Seen>::kMost);
  for (int key = 0; key < most + 10; ++key) memory.note(key, Time{});
  EXPECT_EQ(memory.size(), static_cast<std::size_t>(most));
  EXPECT_EQ(memory.find(9), nullptr);
  EXPECT_NE(memory.find(10), nullptr);
}

TEST(Memory, KeepsTheValue) {
  Memory<int, int> memory;
  memory.note(1, Time{}).first = 5;
  EXPECT_EQ(*memory.find(1), 5);
  EXPECT_EQ(memory.note(1, Time{1s}).first, 5);
}

}  // namespace
}  // namespace hal::node::routing
