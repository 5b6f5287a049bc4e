#include "hal/node/exchange/foreign_call.h"

#include <gtest/gtest.h>

#include <atomic>
#include <optional>
#include <thread>

namespace hal::node::exchange {
namespace {

using namespace std::chrono_literals;

TEST(ForeignCall, NothingIsSeizedWhileTheThreadIsTheHostsOwn) {
  EXPECT_FALSE(seize_call());
  { const ForeignCall call("controller of r0", "step()", Time{2s}); }
  EXPECT_FALSE(seize_call());
}

TEST(ForeignCall, TwoAtATimeLeaveNothingBehind) {  // as in a test with two controllers
  {
    std::optional<ForeignCall> first(std::in_place, "controller of r0", "step()", Time{});
    const ForeignCall second("controller of r1", "step()", Time{});
    first.reset();
  }
  EXPECT_FALSE(seize_call());
}

/// Ends the process, as whoever seizes a call must: its thread stands still for good.
TEST(ForeignCallDeathTest, IsSeizedOnceAndDoesNotReturn) {
  const auto seize = [] {
    std::atomic<bool> under_way{false}, returned{false}, goes_on{false};
    std::thread([&] {
      {
        const ForeignCall call("controller of r0", "step()", Time{2s});
        under_way = true;
        while (!goes_on) std::this_thread::yield();
      }
      returned = true;
    }).detach();
    while (!under_way) std::this_thread::yield();
    const auto call = seize_call();
    const bool is_it = call && call->who == "controller of r0" && call->what == "step()" &&
                       call->at == Time{2s} && !seize_call();
    goes_on = true;
    std::this_thread::sleep_for(100ms);  // Enough to return, if it did.
    std::_Exit(is_it && !returned ? 0 : 1);
  };
  EXPECT_EXIT(seize(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace hal::node::exchange
