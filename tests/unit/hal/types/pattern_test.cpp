#include "hal/types/pattern.h"

#include <gtest/gtest.h>

namespace hal {
namespace {

TEST(Pattern, MatchesNamesAsAShellDoes) {
  EXPECT_TRUE(matches("m17", "m17"));
  EXPECT_TRUE(matches("m*", "m17"));
  EXPECT_TRUE(matches("*", "m17"));
  EXPECT_TRUE(matches("m?7", "m17"));
  EXPECT_TRUE(matches("*7", "m77"));
  EXPECT_TRUE(matches("m*1*3", "m11123"));
  EXPECT_TRUE(matches("m17*", "m17"));
  EXPECT_TRUE(matches("*", ""));
  EXPECT_TRUE(matches("*a*b", "xaxbxab"));
  EXPECT_TRUE(matches("a**b", "ab"));
}

TEST(Pattern, MatchesTheWholeName) {
  EXPECT_FALSE(matches("m1", "m17"));
  EXPECT_FALSE(matches("7", "m17"));
  EXPECT_FALSE(matches("m?", "m17"));
  EXPECT_FALSE(matches("m?", "m"));
  EXPECT_FALSE(matches("*ab", "aba"));
  EXPECT_FALSE(matches("m??7", "m17"));
  EXPECT_FALSE(matches("*8", "m17"));
  EXPECT_FALSE(matches("m*1*4", "m11123"));
  EXPECT_FALSE(matches("", "m17"));
  EXPECT_FALSE(matches("?", ""));
}

}  // namespace
}  // namespace hal
