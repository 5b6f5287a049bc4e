#include "gateway/process/status_of_command.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <functional>
#include <string>
#include <system_error>

#include "gateway/process/domains.h"
#include "gateway/process/exit_status.h"
#include "hal/files/config/errors.h"

namespace gateway::process {
namespace {

struct Said {
  int status = -1;
  std::string text;  ///< On standard error.
};

Said run(const std::function<int()>& command) {
  testing::internal::CaptureStderr();
  Said said;
  said.status = status_of_command(command);
  said.text = testing::internal::GetCapturedStderr();
  return said;
}

TEST(StatusOfCommand, IsWhatTheCommandReturns) {
  for (const int status : {0, 1, 3}) {
    const Said said = run([status] { return status; });
    EXPECT_EQ(said.status, status);
    EXPECT_EQ(said.text, "");
  }
}

TEST(StatusOfCommand, MistakesInFilesStandForThemselves) {
  const Said said =
      run([]() -> int { throw hal::files::config::ConfigErrors({"a.yaml:1:2: key: bad"}); });
  EXPECT_EQ(said.status, kUsage);
  EXPECT_EQ(said.text, "a.yaml:1:2: key: bad\n");
}

TEST(StatusOfCommand, UsageIsAnErrorOfItsOwn) {
  const Said said = run([]() -> int { throw UsageError("no such \x1b[1mthing"); });
  EXPECT_EQ(said.status, kUsage);
  EXPECT_EQ(said.text, "error: no such \\x1b[1mthing\n");
}

TEST(StatusOfCommand, AnInterruptionIsNoError) {
  const Said said = run([]() -> int { throw Interrupted("interrupted"); });
  EXPECT_EQ(said.status, kInterrupted);
  EXPECT_EQ(said.text, "interrupted\n");
}

TEST(StatusOfCommand, AThreadThatCannotBeMadeNamesTheLimit) {
  const Said said =
      run([]() -> int { throw std::system_error(EAGAIN, std::system_category(), "thread"); });
  EXPECT_EQ(said.status, kRunFailed);
  EXPECT_NE(said.text.find("ulimit"), std::string::npos) << said.text;
}

TEST(StatusOfCommand, AllElseIsAFailedRun) {
  const Said said = run([]() -> int { throw std::runtime_error("disk full"); });
  EXPECT_EQ(said.status, kRunFailed);
  EXPECT_EQ(said.text, "error: disk full\n");
}

}  // namespace
}  // namespace gateway::process
