#include "baraka/run/network/network_report.h"

#include <gtest/gtest.h>

namespace baraka::run::network {
namespace {

using namespace std::chrono_literals;

/// What is said of a run of so many frames, of which so many were late, at one edge and the other.
std::vector<std::string> warnings(std::uint64_t frames, std::uint64_t late) {
  sim::agents::AirSummary entering, leaving;
  entering.entering.frames = leaving.leaving.frames = frames;
  entering.entering.beyond_limit = leaving.leaving.beyond_limit = late;
  auto lines = network_warnings(entering, {}, 1, 1ms);
  EXPECT_EQ(network_warnings(leaving, {}, 1, 1ms).size(), lines.size());
  return lines;
}

TEST(LateFrames, OfFewAreCountedIfMostAre) {
  EXPECT_TRUE(warnings(0, 0).empty());
  EXPECT_TRUE(warnings(6, 2).empty());
  EXPECT_TRUE(warnings(98, 49).empty());
  EXPECT_EQ(warnings(98, 50),
            std::vector<std::string>{"50 of the 98 frames that programs sent were "
                                     "more than 1 ms late"});
  EXPECT_EQ(warnings(99, 99).size(), 1U);
}

// Wilson's interval of 95 % begins, by hand with z = 1.96, at 0.55 % for 2 of 100, 1.03 % for 3,
// and at 1.00 % between 119 and 120 of 10,000.
TEST(LateFrames, OfManyAreSaidIfMoreThanOneInAHundredAreForSure) {
  EXPECT_TRUE(warnings(100, 1).empty());
  EXPECT_TRUE(warnings(100, 2).empty());
  EXPECT_EQ(warnings(100, 3).size(), 1U);
  EXPECT_TRUE(warnings(10'000, 100).empty());
  EXPECT_TRUE(warnings(10'000, 119).empty());
  EXPECT_EQ(warnings(10'000, 120).size(), 1U);
  EXPECT_EQ(warnings(100, 100),
            std::vector<std::string>{
                "this computer was too slow for this run: 100.0 % of the frames that programs sent "
                "were more than 1 ms late; a smaller F of --pace realtime:F gives it more time "
                "(now 1)"});
}

TEST(Ends, ThatAreCutOffAreSaid) {
  NetworkSummary network;
  network.lockstep.emplace();
  EXPECT_TRUE(held_network_warnings({}, network).empty());
  network.ends_in_turns = false;
  EXPECT_EQ(held_network_warnings({}, network),
            std::vector<std::string>{
                "programs took too much wall time to end, and the rest ended all at once: what "
                "they wrote after the end of the run need not be equal in equal runs"});
}

}  // namespace
}  // namespace baraka::run::network
