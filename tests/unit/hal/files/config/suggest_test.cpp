#include "hal/files/config/suggest.h"

#include <gtest/gtest.h>

namespace hal::files::config {
namespace {

const std::vector<std::string> kKeys = {"cca_threshold", "sensitivity", "slot", "sifs"};

TEST(Suggestion, NamesTheKeyThatWasProbablyMeant) {
  EXPECT_EQ(suggestion("cca_treshold", kKeys), "; did you mean 'cca_threshold'?");
  EXPECT_EQ(suggestion("sensitivitty", kKeys), "; did you mean 'sensitivity'?");
  EXPECT_EQ(suggestion("slots", kKeys), "; did you mean 'slot'?");
}

TEST(Suggestion, IsSilentWhenNothingIsNear) {
  EXPECT_EQ(suggestion("colour", kKeys), "");
  EXPECT_EQ(suggestion("slot", {}), "");
  EXPECT_EQ(suggestion("", kKeys), "");
}

TEST(Suggestion, CountsTwoSwappedLettersAsOneEdit) {
  EXPECT_EQ(suggestion("wrold", {"world"}), "; did you mean 'world'?");
  EXPECT_EQ(suggestion("sefd", {"seed", "safe"}), "; did you mean 'seed'?");
  EXPECT_EQ(suggestion("slto", kKeys), "; did you mean 'slot'?");
  EXPECT_EQ(suggestion("edn", {"end"}), "; did you mean 'end'?");
  EXPECT_EQ(suggestion("wlrod", {"world"}), "") << "two swaps of five letters";
  EXPECT_EQ(suggestion("ca", {"abc"}), "") << "no letter is edited twice";
}

// "ab" -> "ba" is one edit of two letters: too far. One letter of three is just near enough.
TEST(Suggestion, AllowsAThirdOfTheLettersToDiffer) {
  EXPECT_EQ(suggestion("ba", {"ab"}), "");
  EXPECT_EQ(suggestion("abd", {"abc"}), "; did you mean 'abc'?");
  EXPECT_EQ(suggestion("abde", {"abcf"}), "");
}

TEST(Suggestion, PrefersTheNearestThenTheFirst) {
  EXPECT_EQ(suggestion("wall", {"walks", "walls"}), "; did you mean 'walls'?");
  EXPECT_EQ(suggestion("cat", {"car", "cab"}), "; did you mean 'car'?");
}

}  // namespace
}  // namespace hal::files::config
