#include "baraka/run/network/tap_bridge.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>
#include <thread>

#include "tests/support/fake_clock.h"
#include "tests/support/printers.h"

/// With sockets in place of TAPs: they keep datagrams apart, too.
namespace baraka::run::network {
namespace {

using namespace std::chrono_literals;
using hal::Time;
using Bytes = std::vector<std::uint8_t>;

constexpr hal::AgentId kA{1}, kB{2};

/// The end that the run holds, and the end that the programs have.
struct Cable {
  Cable() {
    if (::socketpair(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0, ends) != 0)
      throw std::runtime_error("no socket");
  }
  ~Cable() {
    ::close(ends[0]);
    ::close(ends[1]);
  }
  void send(const Bytes& bytes) const {
    ASSERT_EQ(::write(ends[1], bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  }
  Bytes received() const {
    Bytes bytes(4096);
    const ssize_t size = ::read(ends[1], bytes.data(), bytes.size());
    bytes.resize(static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
    return bytes;
  }
  int ends[2] = {-1, -1};
};

class TapBridgeTest : public testing::Test {
 protected:
  TapBridgeTest() { (void)clock.now(); }

  std::vector<sim::air::SentFrame> read(std::size_t most = 100) {
    std::vector<sim::air::SentFrame> frames;
    bridge.read(most, [&](sim::air::SentFrame frame) { frames.push_back(std::move(frame)); });
    return frames;
  }
  bool is_readable() const {
    pollfd poll{.fd = bridge.descriptor(), .events = POLLIN, .revents = 0};
    return ::poll(&poll, 1, 0) == 1;
  }
  void pass(hal::Duration time) { wall.run_until(wall.now() + time); }

  tests::FakeClock wall;
  pace::WallPace pace{{.once_a_second = [] {}}, wall};
  pace::RealTimeClock clock{0.5, pace};
  Cable a, b;
  programs::netns::RoomPage room_a, room_b;
  TapBridge bridge{{{kB, b.ends[0], &room_b}, {kA, a.ends[0], &room_a}}, clock};
};

TEST_F(TapBridgeTest, WritesAFrameToItsAgentsInterface) {
  bridge.on_frame(kB, Time{}, Bytes{1, 2, 3});
  bridge.on_frame(kA, Time{}, Bytes{4});
  EXPECT_EQ(b.received(), (Bytes{1, 2, 3}));
  EXPECT_EQ(a.received(), (Bytes{4}));
  EXPECT_EQ(bridge.not_taken(), 0u);
  ::shutdown(b.ends[1], SHUT_RD);
  bridge.on_frame(kB, Time{}, Bytes{1});
  EXPECT_EQ(bridge.not_taken(), 1u);
}

TEST_F(TapBridgeTest, ReadsFramesWithoutWaitingAndNoMoreThanItIsTold) {
  EXPECT_TRUE(read().empty());
  EXPECT_FALSE(is_readable());
  for (const Bytes& bytes : {Bytes{1}, Bytes{2}, Bytes{3}}) a.send(bytes);
  b.send({9, 9});
  EXPECT_TRUE(is_readable());
  const auto first = read(2);
  ASSERT_EQ(first.size(), 2u);
  EXPECT_EQ(first[0].agent, kA);
  EXPECT_EQ(first[1].agent, kB);
  const auto rest = read();
  ASSERT_EQ(rest.size(), 2u);
  EXPECT_EQ(rest[0].ethernet, Bytes{2});
  EXPECT_EQ(rest[1].ethernet, Bytes{3});
  EXPECT_FALSE(is_readable());
}

/// In simulated time, which is half as fast as the wall.
TEST_F(TapBridgeTest, AFrameIsThereSinceItsInterfaceWasLastSeenEmptyAtMost) {
  pass(10ms);
  (void)read();  // sees both empty
  pass(4ms);
  a.send({1});
  pass(2ms);
  auto frames = read();
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].since, Time{5ms});
  pass(4ms);
  a.send({2});
  b.send({3});
  frames = read();
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].since, Time{8ms});
  EXPECT_EQ(frames[1].since, Time{8ms}) << "b was seen empty while a had something";
}

TEST_F(TapBridgeTest, TellsSendersOfTheRoomOnceWhatTheySentIsRead) {
  bridge.on_room(kA, {.free = 2, .capacity = 4});
  EXPECT_TRUE(room_a.reserve(2));
  EXPECT_FALSE(room_a.reserve(1));
  EXPECT_FALSE(room_b.reserve(1)) << "not told of yet";
  a.send({1});
  a.send({2});
  room_a.finish(2);
  bridge.on_room(kA, {.free = 2, .capacity = 4});
  EXPECT_FALSE(room_a.reserve(1)) << "they have not been read";
  EXPECT_EQ(read().size(), 2u);
  bridge.on_room(kA, {.free = 1, .capacity = 4});
  EXPECT_TRUE(room_a.reserve(1));
  EXPECT_FALSE(room_a.reserve(1));
}

TEST_F(TapBridgeTest, LooksAgainWhileASenderIsBetweenItsTwoSteps) {
  bridge.on_room(kA, {.free = 2, .capacity = 2});
  EXPECT_FALSE(bridge.is_one_sending());
  ASSERT_TRUE(room_a.reserve(2));
  a.send({1});
  (void)read();
  bridge.on_room(kA, {.free = 1, .capacity = 2});
  EXPECT_TRUE(bridge.is_one_sending());
  room_a.finish(2);
  (void)read();
  bridge.on_room(kA, {.free = 1, .capacity = 2});
  EXPECT_FALSE(bridge.is_one_sending());
  EXPECT_TRUE(room_a.reserve(1));
}

/// Nothing else happens: no frame comes, and the room of the queue stays what it was.
TEST_F(TapBridgeTest, GivesUpASenderThatWasKilledBeforeItSentAnything) {
  const auto look = [this] {
    (void)read();
    bridge.on_room(kA, {.free = 2, .capacity = 2});
  };
  look();
  look();
  ASSERT_TRUE(room_a.reserve(2));  // and no more is heard of it
  look();
  EXPECT_TRUE(bridge.is_one_sending());
  for (int i = 0; i < 10'000 && bridge.is_one_sending(); ++i) {
    look();
    std::this_thread::sleep_for(1ms);
  }
  EXPECT_FALSE(bridge.is_one_sending());
  EXPECT_TRUE(room_a.reserve(2));
}

TEST_F(TapBridgeTest, AnAgentThatSendsWithoutEndLeavesTheOthersTheirShare) {
  for (int i = 0; i < 150; ++i) a.send({1});
  for (std::uint8_t i = 1; i <= 3; ++i) b.send({9, i});
  auto frames = read(40);
  EXPECT_EQ(std::ranges::count(frames, kB, &sim::air::SentFrame::agent), 3);
  EXPECT_EQ(frames.size(), 40u) << "what the others leave is a's";
  b.send({9, 4});
  frames = read(100);
  EXPECT_EQ(frames.size(), 100u);
  EXPECT_EQ(std::ranges::count(frames, kB, &sim::air::SentFrame::agent), 1);
  EXPECT_EQ(read().size(), 150u + 4u - 140u);
  EXPECT_FALSE(is_readable());
}

}  // namespace
}  // namespace baraka::run::network
