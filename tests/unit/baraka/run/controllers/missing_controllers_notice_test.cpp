#include "baraka/run/controllers/missing_controllers_notice.h"

#include <gtest/gtest.h>

#include "tests/support/fake_clock.h"
#include "tests/support/printers.h"

namespace baraka::run::controllers {
namespace {

using namespace std::chrono_literals;

TEST(MissingControllersNotice, IsSaidAtOnceAndThenEvery5SecondsWhileSomebodyIsMissing) {
  tests::FakeClock clock;
  MissingControllersNotice notice({}, {}, 7, 30s, clock);
  const std::vector<hal::AgentId> missing{hal::AgentId{1}};
  testing::internal::CaptureStderr();
  for (int i = 0; i < 120; ++i) {
    notice.say(missing);
    notice.say({});
    clock.run_until(clock.now() + 100ms);
  }
  const std::string said = testing::internal::GetCapturedStderr();
  const std::string rest = "waiting for controllers of 1 agent, 30 s for the next to come; type:\n";
  EXPECT_EQ(said, rest + "still " + rest + "still " + rest);
}

}  // namespace
}  // namespace baraka::run::controllers
