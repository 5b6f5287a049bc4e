#include "programs/preload/room.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/select.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <functional>
#include <new>
#include <string>
#include <thread>

#include "programs/preload/datagram.h"
#include "tests/unit/programs/preload/recorder/recorder.h"

// Nothing is sent: what reaches the recorder in place of the kernel is counted.
namespace programs::preload {
namespace {

constexpr std::uint32_t kOwnAddress = 0x0a4d0001;  // 10.77.0.1
constexpr std::uint32_t kPlenty = 1000;

sockaddr_in to(const char* address) {
  sockaddr_in result{};
  result.sin_family = AF_INET;
  result.sin_port = htons(9);
  inet_pton(AF_INET, address, &result.sin_addr);
  return result;
}

sockaddr_in6 to6(const char* address, unsigned scope = 0) {
  sockaddr_in6 result{};
  result.sin6_family = AF_INET6;
  result.sin6_port = htons(9);
  result.sin6_scope_id = scope;
  inet_pton(AF_INET6, address, &result.sin6_addr);
  return result;
}

class Room : public testing::Test {
 protected:
  Room() {
    room()->set_interface({kOwnAddress, 1500, {0xfe, 0x80}, {0xfd, 0x00}});
    leave(kPlenty);
    tests::recorder::set_sending(true);
    udp_ = socket(AF_INET, SOCK_DGRAM, 0);
    udp6_ = socket(AF_INET6, SOCK_DGRAM, 0);
  }
  ~Room() override {
    tests::recorder::set_sending(false);
    close(udp_);
    close(udp6_);
    leave(kPlenty);
  }

  /// So much room, whatever was reserved before.
  static void leave(std::uint32_t places) {
    const std::uint64_t before = room()->sent();
    room()->publish(before, places, kPlenty);
  }

  /// Places that a call has taken, and whether it came to the kernel.
  struct Taken {
    std::uint64_t places;
    std::size_t calls;
    bool operator==(const Taken&) const = default;
  };
  friend void PrintTo(const Taken& taken, std::ostream* out) {
    *out << taken.places << " places, " << taken.calls << " calls";
  }
  static Taken taken(const std::function<void()>& call, int result = 1, int error = 0) {
    const std::uint64_t before = room()->sent();
    tests::recorder::arm({.result = result, .error = error});
    call();
    const std::size_t calls = tests::recorder::disarm().size();
    return {room()->sent() - before, calls};
  }
  Taken taken_to(const sockaddr_in& where, std::size_t length) const {
    return taken([&] {
      sendto(udp_, bytes_.data(), length, 0, reinterpret_cast<const sockaddr*>(&where),
             sizeof where);
    });
  }
  Taken taken_to(const sockaddr_in6& where, std::size_t length) const {
    return taken([&] {
      sendto(udp6_, bytes_.data(), length, 0, reinterpret_cast<const sockaddr*>(&where),
             sizeof where);
    });
  }

  int udp_, udp6_;
  std::string bytes_ = std::string(65'507, 'x');
};

TEST_F(Room, IsTakenByWhatLeavesTheHost) {
  const Taken one{1, 1}, none{0, 1};
  EXPECT_EQ(taken_to(to("10.77.0.2"), 10), one);
  EXPECT_EQ(taken_to(to("10.77.255.255"), 10), one);
  EXPECT_EQ(taken_to(to("239.255.0.1"), 10), one);
  EXPECT_EQ(taken_to(to("127.0.0.1"), 10), none);
  EXPECT_EQ(taken_to(to("127.3.0.9"), 10), none);
  EXPECT_EQ(taken_to(to("10.77.0.1"), 10), none) << "its own address";
  EXPECT_EQ(taken_to(to6("fe80::1", 2), 10), one);
  EXPECT_EQ(taken_to(to6("fe80::", 2), 10), none) << "its own address";
  EXPECT_EQ(taken_to(to6("fd00::"), 10), none) << "its own address";
  EXPECT_EQ(taken_to(to6("::1"), 10), none);
  EXPECT_EQ(taken_to(to6("ff02::1", 2), 10), one);
  EXPECT_EQ(taken_to(to6("ff02::1", 1), 10), none) << "by lo";
  EXPECT_EQ(taken_to(to6("::ffff:10.77.0.2"), 10), one);
  EXPECT_EQ(taken_to(to6("::ffff:127.0.0.1"), 10), none);
}

TEST_F(Room, IsNotTakenByGroupsThatGoByLoopback) {
  const in_addr loopback{htonl(INADDR_LOOPBACK)};
  ASSERT_EQ(setsockopt(udp_, IPPROTO_IP, IP_MULTICAST_IF, &loopback, sizeof loopback), 0);
  EXPECT_EQ(taken_to(to("239.255.0.1"), 10), (Taken{0, 1}));
}

TEST_F(Room, IsNotTakenByStreamsAndFiles) {
  std::array<int, 2> pipe_ends{};
  ASSERT_EQ(pipe(pipe_ends.data()), 0);
  EXPECT_EQ(taken([&] { static_cast<void>(!write(pipe_ends[1], "x", 1)); }), (Taken{0, 1}));
  const int tcp = socket(AF_INET, SOCK_STREAM, 0);
  EXPECT_EQ(taken([&] { send(tcp, "x", 1, 0); }), (Taken{0, 1}));
  for (const int one : {pipe_ends[0], pipe_ends[1], tcp}) close(one);
}

// RFC 791, 3.2: 1480 bytes behind a header of 20 in 1500; UDP's own header is 8 of them. RFC 8200,
// 4.5: 1448 = (1500 - 40 - 8) / 8 * 8.
TEST_F(Room, IsTakenByEveryFragment) {
  EXPECT_EQ(taken_to(to("10.77.0.2"), 1472).places, 1);
  EXPECT_EQ(taken_to(to("10.77.0.2"), 1473).places, 2);
  EXPECT_EQ(taken_to(to("10.77.0.2"), 2 * 1480 - 8).places, 2);
  EXPECT_EQ(taken_to(to("10.77.0.2"), 2 * 1480 - 7).places, 3);
  EXPECT_EQ(taken_to(to("10.77.0.2"), 65'507).places, 45);
  EXPECT_EQ(taken_to(to6("fd00::2"), 1452).places, 1);
  EXPECT_EQ(taken_to(to6("fd00::2"), 1453).places, 2);
  EXPECT_EQ(fragments(8 + 8000, 576, false), 15);  // 552 each: 14 * 552 = 7728
  // At 1402 a fragment carries 1376, the last one up to 1382.
  EXPECT_EQ(fragments(1376 + 1382, 1402, false), 2);
  EXPECT_EQ(fragments(1376 + 1383, 1402, false), 3);
}

TEST_F(Room, IsGivenBackByWhatTheKernelRefuses) {
  const sockaddr_in where = to("10.77.0.2");
  leave(1);
  const auto refused = taken(
      [&] {
        EXPECT_EQ(sendto(udp_, "x", 1, 0, reinterpret_cast<const sockaddr*>(&where), sizeof where),
                  -1);
        EXPECT_EQ(errno, EMSGSIZE);
      },
      -1, EMSGSIZE);
  EXPECT_EQ(refused, (Taken{0, 1}));
  EXPECT_TRUE(room()->has_room(1));
}

TEST_F(Room, ThatIsNoneIsEagainWithoutWaitingWhereAskedFor) {
  const sockaddr_in where = to("10.77.0.2");
  const auto attempt = [&](int flags) {
    return taken([&] {
      EXPECT_EQ(
          sendto(udp_, "x", 1, flags, reinterpret_cast<const sockaddr*>(&where), sizeof where), -1);
      EXPECT_EQ(errno, EAGAIN);
    });
  };
  leave(0);
  EXPECT_EQ(attempt(MSG_DONTWAIT), (Taken{0, 0}));
  fcntl(udp_, F_SETFL, O_NONBLOCK);
  EXPECT_EQ(attempt(0), (Taken{0, 0}));
  leave(1);
  EXPECT_EQ(taken_to(where, 1), (Taken{1, 1}));
  EXPECT_EQ(attempt(0), (Taken{0, 0}));
}

TEST_F(Room, IsWaitedForAsLongAsTheSocketSays) {
  const timeval half{0, 500'000};
  ASSERT_EQ(setsockopt(udp_, SOL_SOCKET, SO_SNDTIMEO, &half, sizeof half), 0);
  const sockaddr_in where = to("10.77.0.2");
  leave(0);
  tests::recorder::arm({.result = -1, .error = ETIMEDOUT});
  EXPECT_EQ(sendto(udp_, "x", 1, 0, reinterpret_cast<const sockaddr*>(&where), sizeof where), -1);
  EXPECT_EQ(errno, EAGAIN);
  const auto calls = tests::recorder::disarm();
  ASSERT_EQ(calls.size(), 1);
  EXPECT_EQ(calls[0].name, "futex");
  // 2 s of the kernel's time, less what has passed.
  EXPECT_LE(calls[0].times[0], 2'000'000'000);
  EXPECT_GT(calls[0].times[0], 1'000'000'000);
}

/// A datagram that waits for its places in a thread of its own.
class Waiter {
 public:
  Waiter(int socket, std::uint32_t fragments)
      : thread_([this, socket, fragments] {
          error_ = take_places(socket, fragments, 0, places_);
          has_ended_ = true;
        }) {
    wait_until([] { return room()->waiting().load() != 0; });
  }

  /// Looks for so long that only a hang fails; what hangs is then let go.
  template <class Condition>
  static void wait_until(const Condition& is_so) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!is_so() && std::chrono::steady_clock::now() < end) std::this_thread::yield();
    EXPECT_TRUE(is_so());
    if (!is_so()) room()->publish(room()->sent(), 1'000'000, 1'000'000);
  }
  bool has_ended() const { return has_ended_; }
  /// Its places.
  std::uint32_t get() {
    wait_until([this] { return has_ended(); });
    thread_.join();
    EXPECT_EQ(error_, 0);
    return places_;
  }

 private:
  std::uint32_t places_ = 0;
  int error_ = -1;
  std::atomic<bool> has_ended_ = false;
  std::thread thread_;
};

// Without a collector whoever needs one place takes each as it gets free.
TEST_F(Room, IsKeptPieceByPieceForALargeDatagram) {
  leave(0);
  const std::uint64_t sent = room()->sent();
  Waiter large(udp_, 5);
  for (std::uint32_t free = 1; free <= 5 && !HasFailure(); ++free) {
    EXPECT_FALSE(large.has_ended());
    room()->publish(sent, free, kPlenty);
    Waiter::wait_until([] { return !room()->has_room(1); });
  }
  EXPECT_EQ(large.get(), 5);
  room()->finish(5);
}

TEST_F(Room, IsKeptForOneAtATimeAndGivenBackAtTheEndOfItsTime) {
  leave(0);
  const std::uint64_t sent = room()->sent();
  Waiter first(udp_, 3);
  room()->publish(sent, 1, kPlenty);
  Waiter::wait_until([] { return !room()->has_room(1); });
  const timeval soon{0, 1000};
  ASSERT_EQ(setsockopt(udp6_, SOL_SOCKET, SO_SNDTIMEO, &soon, sizeof soon), 0);
  std::uint32_t places = 0;
  EXPECT_EQ(take_places(udp6_, 3, 0, places), EAGAIN);
  EXPECT_EQ(places, 0);
  room()->publish(sent, 3, kPlenty);
  EXPECT_EQ(first.get(), 3);
  room()->finish(3);
  // Now alone, it collects, and has nothing of it when its time is over.
  leave(2);
  EXPECT_EQ(take_places(udp6_, 3, 0, places), EAGAIN);
  EXPECT_TRUE(room()->has_room(2));
}

// Before the run has published, nobody knows how many places there are at all.
TEST_F(Room, IsAllOfTheQueueForADatagramThatWaitsSinceBeforeTheFirstPublish) {
  new (room()) netns::RoomPage;
  Waiter large(udp_, 45);
  room()->publish(0, 20, 20);
  EXPECT_EQ(large.get(), 20);
  room()->finish(20);
}

TEST_F(Room, LetsThroughAsManyMessagesAsFit) {
  sockaddr_in where = to("10.77.0.2");
  iovec part{bytes_.data(), 2000};  // two fragments
  std::array<mmsghdr, 5> messages{};
  for (mmsghdr& one : messages) {
    one.msg_hdr.msg_name = &where;
    one.msg_hdr.msg_namelen = sizeof where;
    one.msg_hdr.msg_iov = &part;
    one.msg_hdr.msg_iovlen = 1;
  }
  leave(7);
  const auto some = taken([&] { EXPECT_EQ(sendmmsg(udp_, messages.data(), 5, MSG_DONTWAIT), 3); });
  EXPECT_EQ(some, (Taken{6, 1}));
  leave(1);
  const auto none = taken([&] {
    EXPECT_EQ(sendmmsg(udp_, messages.data(), 5, MSG_DONTWAIT), -1);
    EXPECT_EQ(errno, EAGAIN);
  });
  EXPECT_EQ(none, (Taken{0, 0}));
}

TEST_F(Room, IsTakenByAllCallsThatSend) {
  const sockaddr_in where = to("127.0.0.1");
  // Connected to loopback, it takes none; what it says of itself is asked in either case.
  ASSERT_EQ(connect(udp_, reinterpret_cast<const sockaddr*>(&where), sizeof where), 0);
  EXPECT_EQ(taken([&] { send(udp_, "x", 1, 0); }), (Taken{0, 1}));
  sockaddr_in other = to("10.77.0.2");
  iovec part{bytes_.data(), 10};
  msghdr message{};
  message.msg_name = &other;
  message.msg_namelen = sizeof other;
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  EXPECT_EQ(taken([&] { sendmsg(udp_, &message, 0); }), (Taken{1, 1}));
  room()->set_interface({kOwnAddress, 1500, {}, {}});
  const int connected = socket(AF_INET, SOCK_DGRAM, 0);
  // By name of the interface, so that it takes no route there.
  ASSERT_EQ(setsockopt(connected, SOL_SOCKET, SO_BINDTODEVICE, "lo", 3), 0);
  ASSERT_EQ(connect(connected, reinterpret_cast<const sockaddr*>(&other), sizeof other), 0);
  EXPECT_EQ(taken([&] { send(connected, "x", 1, 0); }), (Taken{1, 1}));
  EXPECT_EQ(taken([&] { static_cast<void>(!write(connected, "x", 1)); }), (Taken{1, 1}));
  EXPECT_EQ(taken([&] { static_cast<void>(!writev(connected, &part, 1)); }), (Taken{1, 1}));
  close(connected);
}

TEST_F(Room, ThatIsNoneMakesSocketsUnwritable) {
  const auto polled = [this](int timeout) {
    pollfd one{udp_, POLLOUT | POLLIN, 0};
    const int ready = poll(&one, 1, timeout);
    return std::pair(ready, one.revents & POLLOUT);
  };
  const auto selected = [this] {
    fd_set set;
    FD_ZERO(&set);
    FD_SET(udp_, &set);
    timeval timeout{0, 1000};
    const int ready = select(udp_ + 1, nullptr, &set, nullptr, &timeout);
    return std::pair(ready, FD_ISSET(udp_, &set) != 0);
  };
  EXPECT_EQ(polled(0), std::pair(1, int{POLLOUT}));
  EXPECT_EQ(selected(), std::pair(1, true));
  leave(0);
  EXPECT_EQ(polled(0), std::pair(0, 0));
  EXPECT_EQ(polled(1), std::pair(0, 0));
  EXPECT_EQ(selected(), std::pair(0, false));
}

/// POSIX allows sets that end with the word of the last descriptor: this one ends where memory
/// does.
TEST_F(Room, IsWaitedForInSetsThatAreShorterThanAnFdSet) {
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  void* const memory =
      mmap(nullptr, 2 * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(memory, MAP_FAILED);
  ASSERT_EQ(mprotect(static_cast<char*>(memory) + page, page, PROT_NONE), 0);
  ASSERT_LT(udp_, NFDBITS);
  auto* const word = reinterpret_cast<fd_mask*>(static_cast<char*>(memory) + page) - 1;
  timeval timeout{0, 1000};
  leave(0);
  *word = fd_mask{1} << udp_;
  EXPECT_EQ(select(udp_ + 1, nullptr, reinterpret_cast<fd_set*>(word), nullptr, &timeout), 0);
  EXPECT_EQ(*word, 0);
  leave(1);
  *word = fd_mask{1} << udp_;
  EXPECT_EQ(select(udp_ + 1, nullptr, reinterpret_cast<fd_set*>(word), nullptr, &timeout), 1);
  EXPECT_EQ(*word, fd_mask{1} << udp_);
  munmap(memory, 2 * page);
}

}  // namespace
}  // namespace programs::preload
