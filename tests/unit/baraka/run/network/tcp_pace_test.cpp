#include "baraka/run/network/tcp_pace.h"

#include <gtest/gtest.h>

namespace baraka::run::network {
namespace {

using namespace std::chrono_literals;

constexpr hal::Time at(hal::Duration since) { return hal::Time{since}; }

TEST(TcpPace, LetsARunWithoutSegmentsGoOnWithoutAsking) {
  int asked = 0;
  TcpPace pace([&] { return ++asked > 0; });
  EXPECT_EQ(pace.hold(at(1h), at(1ms)), std::nullopt);
  EXPECT_EQ(pace.hold(at(2h), at(2ms)), std::nullopt);
  EXPECT_EQ(asked, 0);
}

TEST(TcpPace, HoldsARunThatIsAheadOfWallTimeWhileThereIsATimer) {
  bool has_timer = true;
  TcpPace pace([&] { return has_timer; });
  EXPECT_EQ(pace.hold(at(10s), at(1s)), std::nullopt);
  pace.on_segment();
  EXPECT_EQ(pace.hold(at(10s + 300us), at(1s)), hal::Duration{300us});
  EXPECT_EQ(pace.hold(at(10s + 200ms), at(1s)), hal::Duration{1ms}) << "at most";
  EXPECT_EQ(pace.reached(at(1s + 120ms)), at(10s + 120ms));
  EXPECT_EQ(pace.hold(at(10s + 200ms), at(1s + 199'980us)), std::nullopt) << "near enough";
  EXPECT_NE(pace.hold(at(11s), at(1s + 200ms)), std::nullopt);
  has_timer = false;
  EXPECT_EQ(pace.hold(at(11s), at(1s + 200ms)), std::nullopt);
  EXPECT_EQ(pace.hold(at(5h), at(1s + 201ms)), std::nullopt) << "until the next segment";
  has_timer = true;
  pace.on_segment();
  EXPECT_NE(pace.hold(at(5h + 1s), at(1s + 202ms)), std::nullopt);
}

TEST(TcpPace, DoesNotLetASlowRunCatchUp) {
  TcpPace pace([] { return true; });
  EXPECT_EQ(pace.hold(at(1s), at(1s)), std::nullopt);
  pace.on_segment();
  EXPECT_EQ(pace.hold(at(1s + 1ms), at(9s)), std::nullopt);
  EXPECT_NE(pace.hold(at(1s + 2ms), at(9s)), std::nullopt);
}

}  // namespace
}  // namespace baraka::run::network
