#include "sim/radio/phy/dsss_mode.h"

#include <gtest/gtest.h>

#include <ctime>

namespace sim::radio {
namespace {

/// Of this thread, ns: of what other processes do, it knows nothing.
std::int64_t processor_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

/// The first reception takes about 1 us. It took 11 ms, in which a run in real time stood still,
/// when it made CCK's table; that shows if no test of the same process has made it before, as here.
TEST(DsssMode, OfCckIsReadyForTheFirstReception) {
  const DsssMode mode(hal::BitsPerSecond{11e6}, {});
  const std::int64_t before = processor_time();
  const double success = mode.success(1, 8);
  const std::int64_t taken = processor_time() - before;
  EXPECT_GT(success, 0);
  EXPECT_LT(success, 1);
  EXPECT_LT(taken, 2'000'000);
}

}  // namespace
}  // namespace sim::radio
