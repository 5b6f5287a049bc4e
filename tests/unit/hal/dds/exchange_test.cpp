#include <gtest/gtest.h>

#include <thread>

#include "hal/dds/controller_process.h"
#include "tests/unit/hal/dds/echo_controller.h"

namespace hal::dds {
namespace {

using exchange::Cause;
constexpr Duration kReplyTimeout = std::chrono::seconds{10};

TEST(Exchange, ControllersAnswerEveryStepAndEndWithTheStop) {
  Server server(take_domain(std::nullopt));
  const ControllerKind kind = echo_kind();
  Outcome outcome = Outcome::kFailed;
  std::thread controllers(
      [&] { outcome = run_controllers(kind, options_for(server.domain(), "m1", "echo")); });
  const exchange::Hello hello = first_hello(server);
  const auto link = server.link(hello, 7, kReplyTimeout);
  ASSERT_TRUE(server.answer(session_for(hello, 7)));

  const auto started = exchange_step(*link, step_with(Cause::kStart, 1));
  const auto stepped = exchange_step(*link, step_with(Cause::kControl, 2));
  const auto stopped = exchange_step(*link, step_with(Cause::kStop, 3));
  controllers.join();

  ASSERT_TRUE(started) << started.error().message;
  ASSERT_TRUE(stepped) << stepped.error().message;
  ASSERT_TRUE(stopped) << stopped.error().message;
  EXPECT_EQ(started->actions.at(0).text, "started");
  EXPECT_EQ(stepped->actions.at(0).text, "stepped 1");
  EXPECT_EQ(stopped->actions.at(0).text, "stopped");
  EXPECT_EQ(stopped->sequence, 3);
  EXPECT_EQ(stopped->process, "echo");
  EXPECT_EQ(outcome, Outcome::kDone);
}

}  // namespace
}  // namespace hal::dds
