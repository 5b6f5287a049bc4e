#include "agentd/emergency_latch.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>

#include "agentd/service_notice.h"

namespace agentd {
namespace {

namespace fs = std::filesystem;

TEST(EmergencyLatch, RemembersAStopForTheNextDaemonOfThatAgentOnly) {
  const fs::path folder =
      fs::temp_directory_path() / ("baraka_latch_" + std::to_string(::getpid()));
  fs::remove_all(folder);
  {
    const EmergencyLatch latch("r0", folder / "inner");
    EXPECT_FALSE(latch.is_set());
    latch.set(true);
  }
  EXPECT_TRUE(EmergencyLatch("r0", folder / "inner").is_set());
  EXPECT_FALSE(EmergencyLatch("r1", folder / "inner").is_set());
  EmergencyLatch("r0", folder / "inner").set(false);
  EXPECT_FALSE(EmergencyLatch("r0", folder / "inner").is_set());
  fs::remove_all(folder);
}

// As a copied or a broken state folder may have it: the safe side is to stand still.
TEST(EmergencyLatch, ALinkThatLeadsNowhereHolds) {
  const fs::path folder =
      fs::temp_directory_path() / ("baraka_latch_link_" + std::to_string(::getpid()));
  fs::remove_all(folder);
  const EmergencyLatch latch("r0", folder);
  fs::create_symlink(folder / "nowhere", latch.file());
  EXPECT_TRUE(latch.is_set());
  latch.set(true);
  EXPECT_TRUE(latch.is_set());
  EXPECT_FALSE(fs::exists(folder / "nowhere")) << "written through the link";
  latch.set(false);
  EXPECT_FALSE(latch.is_set());
  fs::remove_all(folder);
}

TEST(EmergencyLatch, WithoutAFolderNothingIsRemembered) {
  const EmergencyLatch latch;
  latch.set(true);
  EXPECT_FALSE(latch.is_set());
  EXPECT_TRUE(latch.file().empty());
}

// sd_watchdog_enabled(3): WATCHDOG_USEC is the longest silence, in microseconds.
TEST(ServiceNotice, TheWatchdogIsFedTwicePerItsPeriod) {
  using namespace std::chrono_literals;
  ::unsetenv("WATCHDOG_PID");
  ::setenv("WATCHDOG_USEC", "3000000", 1);
  EXPECT_EQ(watchdog_period(), hal::Duration{1500ms});
  ::unsetenv("WATCHDOG_USEC");
  EXPECT_EQ(watchdog_period(), std::nullopt);
}

}  // namespace
}  // namespace agentd
