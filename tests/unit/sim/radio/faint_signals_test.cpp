#include "sim/radio/channel/faint_signals.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "hal/types/random.h"
#include "tests/unit/sim/radio/air.h"

namespace sim::radio {
namespace {

using namespace std::chrono_literals;

constexpr double kNever = std::numeric_limits<double>::infinity();

/// One receiver that stands still, so that each frame is added.
class FaintSignalsTest : public testing::Test {
 protected:
  FaintSignalsTest() { frames.add_receiver(); }

  EventQueue events;
  test::PlacedAntennas antennas = one_antenna();
  test::Wall free_air;
  Propagation propagation{MobilityFrameworkConfig{}, free_air};
  Neighbourhood neighbourhood{events, antennas, propagation, {{hal::AgentId{1}, {}}}};
  FaintFrames frames{neighbourhood};

 private:
  static test::PlacedAntennas one_antenna() {
    test::PlacedAntennas antennas;
    antennas.place(hal::AgentId{1}, {});
    return antennas;
  }
};

/// The same by looking at everything there ever was.
struct Everything {
  struct Signal {
    hal::Time start, end;
    double power;
  };

  Interference at(hal::Time time) const {
    Interference sum;
    for (const Signal& signal : signals) {
      if (signal.start > time || signal.end <= time) continue;
      sum.sum += signal.power;
      sum.strongest = std::max(sum.strongest, signal.power);
    }
    return sum;
  }
  hal::Time next_change(hal::Time after) const {
    hal::Time next = hal::Time::max();
    for (const Signal& signal : signals) {
      for (const hal::Time edge : {signal.start, signal.end}) {
        if (edge > after && signal.end > after) next = std::min(next, edge);
      }
    }
    return next;
  }

  std::vector<Signal> signals;
};

TEST_F(FaintSignalsTest, AddUpAsIfEachHadBeenFollowed) {
  hal::RandomStream random(1, "faint");
  FaintSignals faint(frames, 0, kNever);
  Everything all;
  hal::Time now{};
  for (int i = 0; i < 3000; ++i) {
    now += hal::Duration{random.below(200'000)};
    const hal::Duration delay{random.below(3000)};
    const hal::Duration airtime{1 + random.below(1'000'000)};
    const double power = random.uniform();
    faint.add(static_cast<StationIndex>(i), now, delay, airtime, power);
    all.signals.push_back({now + delay, now + delay + airtime, power});
    const hal::Time at = now + hal::Duration{random.below(2'000'000)};
    Interference sum;
    hal::Time until = hal::Time::max();
    faint.add_to(sum, at, until);
    ASSERT_DOUBLE_EQ(sum.sum, all.at(at).sum) << i;
    ASSERT_EQ(sum.strongest, all.at(at).strongest) << i;
    ASSERT_EQ(until, all.next_change(at)) << i;
    ASSERT_GE(faint.bound() * (1 + 1e-12), sum.sum) << i;
  }
}

TEST_F(FaintSignalsTest, KeepWhatIsNeededAndNoMore) {
  FaintSignals faint(frames, 0, kNever);
  faint.add(0, hal::Time{}, 0ns, 1us, 1);
  faint.keep_from(hal::Time{});
  for (int i = 1; i < 1000; ++i) faint.add(1, hal::Time{} + i * 1us, 0ns, 1us, 0);
  Interference sum;
  hal::Time until = hal::Time::max();
  faint.add_to(sum, hal::Time{}, until);
  EXPECT_EQ(sum.sum, 1) << "of the beginning, after a thousand more";
  faint.keep_nothing();
  for (int i = 0; i < 10'000; ++i) faint.add(1, hal::Time{} + 1ms + i * 1us, 0ns, 1us, 1);
  EXPECT_LE(faint.bound(), 4000) << "of 10,000 that are over one after the other";
}

TEST_F(FaintSignalsTest, AFrameThatIsCutEndsEarlier) {
  FaintSignals faint(frames, 0, kNever);
  faint.add(7, hal::Time{}, 100ns, 1ms, 2);
  faint.add(8, hal::Time{}, 100ns, 1ms, 3);
  faint.cut(7, hal::Time{}, hal::Time{500us});
  Interference sum;
  hal::Time until = hal::Time::max();
  faint.add_to(sum, hal::Time{500us + 99ns}, until);
  EXPECT_EQ(sum.sum, 5);
  EXPECT_EQ(until, hal::Time{500us + 100ns});
  sum = {};
  faint.add_to(sum, until, until);
  EXPECT_EQ(sum.sum, 3);
}

TEST_F(FaintSignalsTest, AlarmsOnlyWhileTheSumMayReachIt) {
  FaintSignals faint(frames, 0, 2.5);
  EXPECT_FALSE(faint.add(1, hal::Time{}, 0ns, 10us, 1));
  EXPECT_FALSE(faint.add(2, hal::Time{}, 0ns, 10us, 1));
  EXPECT_TRUE(faint.add(3, hal::Time{}, 0ns, 20us, 1));
  EXPECT_FALSE(faint.add(4, hal::Time{10us}, 0ns, 10us, 1)) << "two are over";
  faint.set_alarm(0.5);
  EXPECT_TRUE(faint.add(5, hal::Time{50us}, 0ns, 10us, 1));
}

}  // namespace
}  // namespace sim::radio
