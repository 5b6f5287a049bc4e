#include "programs/netns/room_page.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>
#include <vector>

namespace programs::netns {
namespace {

TEST(RoomPage, HasNoRoomUntilTheRunPublishes) {
  RoomPage page;
  EXPECT_FALSE(page.reserve(1));
  EXPECT_FALSE(page.publish(page.sent(), 3, 10)) << "nobody is in between";
  EXPECT_TRUE(page.reserve(2));
  EXPECT_FALSE(page.reserve(2));
  EXPECT_TRUE(page.reserve(1));
}

TEST(RoomPage, CountsWhatIsReservedAndNotYetDrainedAgainstTheRoom) {
  RoomPage page;
  page.publish(page.sent(), 4, 10);
  ASSERT_TRUE(page.reserve(3));
  page.finish(2);  // two frames in the TAP, one still to come
  // The run drains the two, and its queue of four has two free.
  EXPECT_TRUE(page.publish(2, 2, 10)) << "one is in between";
  EXPECT_TRUE(page.reserve(1));
  EXPECT_FALSE(page.reserve(1));
}

TEST(RoomPage, TakesBackWhatWasNotSent) {
  RoomPage page;
  page.publish(page.sent(), 1, 10);
  ASSERT_TRUE(page.reserve(1));
  page.give_back(1);
  EXPECT_TRUE(page.reserve(1));
}

TEST(RoomPage, LetsADatagramOfMoreFragmentsThanTheQueueInWhenThatIsEmpty) {
  RoomPage page;
  page.publish(page.sent(), 9, 10);
  EXPECT_FALSE(page.reserve(page.places_for(44)));
  page.publish(page.sent(), 10, 10);
  EXPECT_TRUE(page.reserve(page.places_for(44)));
}

TEST(RoomPage, GivesUpASenderThatWasKilledInBetween) {
  RoomPage page;
  page.publish(page.sent(), 1, 1);
  ASSERT_TRUE(page.reserve(1));  // and no more is heard of it
  EXPECT_TRUE(page.publish(page.sent(), 1, 1));
  EXPECT_FALSE(page.reserve(1));
  while (page.publish(page.sent(), 1, 1)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  page.publish(page.sent(), 1, 1);
  EXPECT_TRUE(page.reserve(1));
  // It was only slow: what it has sent after all does not make room for others for ever.
  page.finish(1);
  page.finish(1);
  page.publish(page.sent(), 1, 1);
  EXPECT_TRUE(page.reserve(1));
  EXPECT_FALSE(page.reserve(1));
}

// A collector waits for more than 200 ms where the air is slow: one that says so is not given up,
// but a sender beside it that was killed is.
TEST(RoomPage, GivesUpWhoeverIsSilentBesideACollector) {
  RoomPage page;
  page.publish(0, 4, 10);
  ASSERT_TRUE(page.reserve(1));  // and no more is heard of it
  const std::uint32_t collector = page.start_collecting();
  ASSERT_NE(collector, 0);
  EXPECT_EQ(page.start_collecting(), 0) << "one at a time";
  EXPECT_EQ(page.collect(10), 3);
  while (page.sent() == 0) {
    page.still_collects();
    EXPECT_TRUE(page.publish(page.sent(), 4, 10));
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(page.sent(), 1);
  EXPECT_TRUE(page.is_collecting(collector));
  page.publish(page.sent(), 4, 10);
  EXPECT_EQ(page.collect(10), 1);
  // Silent, it goes too, and another one may collect.
  while (page.publish(page.sent(), 4, 10))
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_FALSE(page.is_collecting(collector));
  EXPECT_EQ(page.sent(), 5);
  EXPECT_NE(page.start_collecting(), 0);
}

// Each sender reserves, "sends" and finishes; the run drains and publishes. Never is there more in
// the queue than it holds.
TEST(RoomPage, KeepsManySendersWithinTheQueue) {
  constexpr std::uint32_t kCapacity = 5;
  constexpr int kSenders = 4, kEach = 3000;
  RoomPage page;
  std::atomic<std::uint32_t> tap = 0;
  std::vector<std::jthread> senders;
  senders.reserve(kSenders);
  page.publish(0, kCapacity, kCapacity);
  for (int i = 0; i < kSenders; ++i) {
    senders.emplace_back([&] {
      for (int n = 0; n < kEach; ++n) {
        while (!page.reserve(1)) std::this_thread::yield();
        ++tap;
        page.finish(1);
      }
    });
  }
  std::uint32_t queue = 0, most = 0, through = 0;
  while (through < kSenders * kEach) {
    const std::uint64_t sent = page.sent();
    queue += tap.exchange(0);
    most = std::max(most, queue);
    if (queue > 0) {
      --queue;
      ++through;
    } else {
      std::this_thread::yield();
    }
    page.publish(sent, kCapacity - std::min(queue, kCapacity), kCapacity);
  }
  EXPECT_LE(most, kCapacity);
}

}  // namespace
}  // namespace programs::netns
