#include "hal/types/pattern.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

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

TEST(Pattern, OverlapsWhereANameMatchesBoth) {
  EXPECT_TRUE(overlap("rt/*.age", "*?.age"));
  EXPECT_TRUE(overlap("*", "*?.age"));
  EXPECT_FALSE(overlap("rt/*.agee", "*?.age"));
  EXPECT_FALSE(overlap(".age", "*?.age")) << "a topic has a name";
}

/// All words of letters up to a length.
std::vector<std::string> words(const std::string& letters, std::size_t longest) {
  std::vector<std::string> all{""};
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].size() == longest) break;
    for (const char letter : letters) all.push_back(all[i] + letter);
  }
  return all;
}

// Two patterns of up to three characters that overlap have a common name of up to six.
TEST(Pattern, OverlapsExactlyIfOneOfAllShortNamesMatchesBoth) {
  const std::vector<std::string> patterns = words("ab*?", 3);
  const std::vector<std::string> names = words("ab", 6);
  for (const std::string& one : patterns) {
    for (const std::string& other : patterns) {
      const bool has_common = std::ranges::any_of(names, [&](const std::string& name) {
        return matches(one, name) && matches(other, name);
      });
      EXPECT_EQ(overlap(one, other), has_common) << one << " and " << other;
    }
  }
}

}  // namespace
}  // namespace hal
