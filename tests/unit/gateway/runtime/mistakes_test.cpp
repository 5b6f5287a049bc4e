#include "gateway/runtime/mistakes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace gateway::runtime {
namespace {

TEST(Mistakes, TheFirstOfAKindIsToldAsItIsThenThoseThatArePowersOfTen) {
  Mistakes mistakes;
  std::vector<std::string> told;
  for (int i = 1; i <= 250; ++i) {
    const auto line = mistakes.add(fmt::format("r0: set_timer: at {}.5 s is before now", i));
    if (line) told.push_back(*line);
  }
  EXPECT_EQ(told, (std::vector<std::string>{
                      "r0: set_timer: at 1.5 s is before now",
                      "r0: set_timer: at 10.5 s is before now (10 times by now)",
                      "r0: set_timer: at 100.5 s is before now (100 times by now)"}));
  EXPECT_EQ(mistakes.rest(),
            std::vector<std::string>{"r0: set_timer: at 1.5 s is before now: 250 times in all"});
}

TEST(Mistakes, OnesOfAnotherKindAreToldToo) {
  Mistakes mistakes;
  EXPECT_TRUE(mistakes.add("set_body_velocity: vx is nan"));
  EXPECT_TRUE(mistakes.add("set_body_velocity: vy is nan"));
  EXPECT_TRUE(mistakes.add("send: topic 'a' has a zero byte"));
  EXPECT_FALSE(mistakes.add("send: topic 'b' has a zero byte")) << "only the name differs";
}

TEST(Mistakes, WhatWasToldInFullIsNotCountedAgain) {
  Mistakes mistakes;
  EXPECT_TRUE(mistakes.rest().empty());
  (void)mistakes.add("once");
  EXPECT_TRUE(mistakes.rest().empty());
}

TEST(Mistakes, NewKindsWithoutEndDoNotFillTheLog) {
  Mistakes mistakes;
  int told = 0;
  for (int i = 0; i < 10'000; ++i) told += mistakes.add(std::string(i + 1, 'x')) ? 1 : 0;
  EXPECT_LT(told, 40);
  EXPECT_EQ(mistakes.rest().size(), 1U);
}

}  // namespace
}  // namespace gateway::runtime
