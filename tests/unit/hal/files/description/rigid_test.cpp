#include "hal/files/description/rigid.h"

#include <gtest/gtest.h>

namespace hal::files::description {
namespace {

TEST(Rigid, ASolidBoxIsOne) { EXPECT_EQ(why_not_solid({0.02, 0.03, 0.04}, {}), std::nullopt); }

TEST(Rigid, AFlatPlateIsOneThoughItsSumIsExact) {
  EXPECT_EQ(why_not_solid({0.001, 0.002, 0.003}, {}), std::nullopt);
}

TEST(Rigid, TheLargestMomentIsNotMoreThanTheSumOfTheOthers) {
  const auto why = why_not_solid({0.001, 0.002, 0.0031}, {});
  ASSERT_TRUE(why);
  EXPECT_EQ(*why,
            "no body has the principal moments 0.001, 0.002 and 0.0031 kg m^2: the largest is more "
            "than the others' sum");
}

// The moments 2, 2 and 2 alone would be those of a ball; with Ixy = 1.5 they are 0.5, 2 and 3.5.
TEST(Rigid, ProductsCount) {
  EXPECT_EQ(why_not_solid({2, 2, 2}, {0.9, 0, 0}), std::nullopt);
  EXPECT_TRUE(why_not_solid({2, 2, 2}, {1.5, 0, 0}));
  EXPECT_TRUE(why_not_solid({2, 2, 2}, {0, 3, 0}));
}

TEST(Rigid, NoMomentIsZeroOrLess) {
  EXPECT_TRUE(why_not_solid({0, 0, 0}, {}));
  EXPECT_TRUE(why_not_solid({1, 1, -1}, {}));
}

}  // namespace
}  // namespace hal::files::description
