#include "programs/preload/dilation.h"

#include <gtest/gtest.h>

#include <limits>

namespace programs::preload {
namespace {

constexpr Nanoseconds kMost = std::numeric_limits<Nanoseconds>::max();
constexpr Nanoseconds kLeast = std::numeric_limits<Nanoseconds>::min();

TEST(Dilation, ReadsFactorsFromAHundredthToOne) {
  for (const char* text : {"1", "1.0", "0.01", "0.25", "0.100000000", "0.333333333"}) {
    EXPECT_TRUE(Dilation::from_text(text)) << text;
  }
  for (const char* text : {"", "2", "1.000000001", "0.009", "0", "-0.5", ".5", "0.", "0.5 ", "1e-1",
                           "0.1234567890", "half", "0.-5", "nan", "0,5"}) {
    EXPECT_FALSE(Dilation::from_text(text)) << text;
  }
}

TEST(Dilation, SlowsTheTimeOfProgramsFromTheOriginOn) {
  const Dilation tenth = *Dilation::from_text("0.1");
  EXPECT_EQ(tenth.to_program(5'000, 1'000), 1'400);
  EXPECT_EQ(tenth.to_program(1'000, 1'000), 1'000);
  EXPECT_EQ(tenth.to_program(0, 1'000), 900) << "before it, too: clocks of lower resolution";
  EXPECT_EQ(tenth.to_program(1'009, 1'000), 1'000) << "rounded down";
  EXPECT_EQ(tenth.to_program(999, 1'000), 999);
  EXPECT_EQ(Dilation().to_program(5'003, 1'000), 5'003);
}

TEST(Dilation, NoWaitEndsBeforeItsTime) {
  for (const char* text : {"1", "0.9", "0.333333333", "0.1", "0.07", "0.01"}) {
    const Dilation dilation = *Dilation::from_text(text);
    Nanoseconds step = 1;
    for (Nanoseconds program = 1; program < kMost / 200; program += step, step = 3 * step + 1) {
      const Nanoseconds kernel = dilation.to_kernel(program, 77);
      EXPECT_GE(dilation.to_program(kernel, 77), program) << text;
      EXPECT_LT(dilation.to_program(kernel - 1, 77), program) << text << ": nor later than needed";
    }
  }
}

TEST(Dilation, WhatDoesNotFitIsTheLargest) {
  const Dilation hundredth = *Dilation::from_text("0.01");
  EXPECT_EQ(hundredth.to_kernel(kMost / 50), kMost);
  EXPECT_EQ(hundredth.to_kernel(kLeast / 50), kLeast);
  EXPECT_EQ(hundredth.to_kernel(kMost, kMost - 1000), kMost);
}

}  // namespace
}  // namespace programs::preload
