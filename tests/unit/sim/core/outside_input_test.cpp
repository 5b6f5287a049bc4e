#include "sim/core/outside_input.h"

#include <gtest/gtest.h>
#include <poll.h>

#include <stdexcept>
#include <thread>

#include "tests/support/printers.h"

namespace sim {
namespace {

using namespace std::chrono_literals;
using Bytes = std::vector<std::uint8_t>;

hal::Time at(hal::Duration since_start) { return hal::Time{since_start}; }

bool is_readable(const OutsideInput& input) {
  pollfd poll{.fd = input.descriptor(), .events = POLLIN, .revents = 0};
  return ::poll(&poll, 1, 0) == 1;
}

/// Two doors, and what came through which.
struct House {
  explicit House(OutsideInput& the_input) : input(the_input) {
    for (const char* door : {"a", "b"}) {
      input.open(door, [this, door](std::span<const std::uint8_t> bytes) {
        received.push_back({now, door, Bytes(bytes.begin(), bytes.end())});
      });
    }
  }
  void take(hal::Time the_now) {
    now = the_now;
    input.take(now, [this](const OutsideArrival& arrival) { seen.push_back(arrival); });
  }

  OutsideInput& input;
  hal::Time now{};
  std::vector<OutsideArrival> seen, received;
};

TEST(OutsideInput, WhatWaitsIsTakenInOnceInItsOrderAtTheTimeOfTheRun) {
  OutsideInput input;
  House house(input);
  house.take(at(1ms));
  EXPECT_TRUE(house.seen.empty());
  input.put("b", {1, 2});
  input.put("a", {});
  house.take(at(5ms));
  const std::vector<OutsideArrival> expected{{at(5ms), "b", {1, 2}}, {at(5ms), "a", {}}};
  EXPECT_EQ(house.seen, expected);
  EXPECT_EQ(house.received, expected);
  house.take(at(6ms));
  EXPECT_EQ(house.seen.size(), 2u);
}

TEST(OutsideInput, ItsDescriptorWakesTheRunUntilItHasTakenEverything) {
  OutsideInput input;
  House house(input);
  EXPECT_FALSE(is_readable(input));
  std::thread([&] { input.put("a", {7}); }).join();
  EXPECT_TRUE(is_readable(input));
  house.take(at(1ms));
  EXPECT_FALSE(is_readable(input));
}

TEST(OutsideInput, OfTooMuchTheOldestGoesAndIsCounted) {
  OutsideInput input;
  House house(input);
  for (std::size_t i = 0; i < OutsideInput::kMostWaiting + 3; ++i) {
    input.put("a", {static_cast<std::uint8_t>(i)});
  }
  EXPECT_EQ(input.dropped(), 3u);
  house.take(at(1ms));
  ASSERT_EQ(house.seen.size(), OutsideInput::kMostWaiting);
  EXPECT_EQ(house.seen.front().bytes, Bytes{3});
}

TEST(OutsideInput, WhatHasATimeIsTakenInThenHoweverMuchWaits) {
  OutsideInput input;
  House house(input);
  constexpr std::size_t kMany = 3 * OutsideInput::kMostWaiting;
  for (std::size_t i = 0; i < kMany; ++i) input.put_at(at(2ms), "a", {1});
  input.put_at(at(3ms), "b", {2});
  input.put("a", {3});
  EXPECT_EQ(input.next_due(), at(2ms));
  EXPECT_TRUE(input.has_due(at(1ms)));
  house.take(at(1ms));
  EXPECT_EQ(house.seen, (std::vector<OutsideArrival>{{at(1ms), "a", {3}}}));
  EXPECT_FALSE(input.has_due(at(1ms)));
  house.take(at(2ms));
  EXPECT_EQ(house.seen.size(), 1 + kMany);
  EXPECT_EQ(input.held(), 1u);
  house.take(at(9ms));
  EXPECT_EQ(house.seen.back(), (OutsideArrival{at(3ms), "b", {2}}));
  EXPECT_EQ(input.dropped(), 0u);
  EXPECT_EQ(input.next_due(), std::nullopt);
}

TEST(OutsideInput, ARepetitionTakesInTheSameAtTheSameTimesAndNothingElse) {
  OutsideInput first_input;
  House first(first_input);
  first_input.put("a", {1});
  first.take(at(2ms));
  first_input.put("b", {2});
  first_input.put("a", {3});
  first.take(at(9ms));

  OutsideInput input;
  House second(input);
  input.replay(first.seen);
  input.put("a", {99});
  EXPECT_EQ(input.next_due(), at(2ms));
  second.take(at(1ms));
  EXPECT_TRUE(second.seen.empty());
  for (const hal::Duration now : {2ms, 8ms, 9ms, 20ms}) second.take(at(now));
  EXPECT_EQ(second.seen, first.seen);
  EXPECT_EQ(second.received, first.received);
  EXPECT_EQ(input.next_due(), std::nullopt);
}

TEST(OutsideInput, ARecordOfADoorThatIsNotOpenIsAnErrorThatNamesIt) {
  OutsideInput input;
  const House house(input);
  try {
    input.replay({{at(1ms), "cmd_vel of r7", {}}});
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("'cmd_vel of r7'"), std::string::npos);
  }
}

}  // namespace
}  // namespace sim
