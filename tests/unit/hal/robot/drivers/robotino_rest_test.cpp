#include "hal/robot/drivers/robotino_rest.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <string>
#include <string_view>
#include <thread>

namespace hal::robot::drivers {
namespace {

using namespace std::chrono_literals;

/// A connection as a device sees it.
class Peer {
 public:
  Peer(int socket, const std::atomic<bool>& is_over) : socket_(socket), is_over_(is_over) {}

  /// False once nobody listens any more.
  bool say(std::string_view bytes) const {
    while (!bytes.empty() && !is_over_) {
      const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (sent <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    return !is_over_;
  }
  void say_for_ever(const std::string& bytes, std::chrono::milliseconds pause = 0ms) const {
    while (say(bytes)) {
      if (pause > 0ms) std::this_thread::sleep_for(pause);
    }
  }
  void say_nothing() const {
    char byte = 0;
    while (!is_over_ && ::recv(socket_, &byte, 1, 0) > 0) {
    }
  }
  void reset() const {
    const linger at_once{.l_onoff = 1, .l_linger = 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
  }

 private:
  int socket_;
  const std::atomic<bool>& is_over_;
};

/// A device on 127.0.0.1 that answers each request as it is told to.
class Device {
 public:
  explicit Device(std::function<void(const Peer&)> answer) : answer_(std::move(answer)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    ::bind(listening_, reinterpret_cast<const sockaddr*>(&address), size);
    ::listen(listening_, 8);
    ::getsockname(listening_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { serve(); });
  }
  ~Device() {
    is_over_ = true;
    ::shutdown(listening_, SHUT_RDWR);
    thread_.join();
    ::close(listening_);
  }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  RobotinoSettings settings() const {
    return {.host = "127.0.0.1", .port = port_, .times = {50ms, 300ms, 500ms}};
  }

 private:
  void serve() {
    for (int socket = 0; (socket = ::accept(listening_, nullptr, nullptr)) >= 0;) {
      const timeval patience{.tv_sec = 1, .tv_usec = 0};
      ::setsockopt(socket, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
      ::setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
      char request[4096];
      if (::recv(socket, request, sizeof request, 0) > 0) answer_({socket, is_over_});
      ::close(socket);
    }
  }

  std::function<void(const Peer&)> answer_;
  std::atomic<bool> is_over_ = false;
  int listening_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  std::uint16_t port_ = 0;
  std::thread thread_;
};

std::string answer(std::string_view body, std::string_view head = "") {
  return fmt::format("HTTP/1.1 200 OK\r\nContent-Length: {}\r\n{}\r\n{}", body.size(), head, body);
}

constexpr const char* kOk = "HTTP/1.1 200 OK\r\n";

struct Hostile {
  const char* name;
  std::function<void(const Peer&)> answer;
};

void PrintTo(const Hostile& hostile, std::ostream* out) { *out << hostile.name; }

const std::string kLong(60'000, 'a');

const Hostile kHostile[] = {
    {"headers_without_end",
     [](const Peer& to) {
       to.say(kOk);
       to.say_for_ever("X-A: " + kLong.substr(0, 8000) + "\r\n");
     }},
    {"short_headers_without_end",
     [](const Peer& to) {
       to.say(kOk);
       to.say_for_ever("A:b\r\n");
     }},
    {"header_line_without_end",
     [](const Peer& to) {
       to.say(std::string(kOk) + "X-A: ");
       to.say_for_ever(kLong);
     }},
    {"status_line_without_end", [](const Peer& to) { to.say_for_ever(kLong); }},
    {"interim_responses_without_end",
     [](const Peer& to) { to.say_for_ever("HTTP/1.1 100 Continue\r\n\r\n"); }},
    {"chunks_without_end",
     [](const Peer& to) {
       to.say(std::string(kOk) + "Transfer-Encoding: chunked\r\n\r\n");
       to.say_for_ever("1000\r\n" + kLong.substr(0, 0x1000) + "\r\n");
     }},
    {"chunk_extension_without_end",
     [](const Peer& to) {
       to.say(std::string(kOk) + "Transfer-Encoding: chunked\r\n\r\n1;");
       to.say_for_ever(kLong);
     }},
    {"chunk_of_huge_length",
     [](const Peer& to) {
       to.say(std::string(kOk) + "Transfer-Encoding: chunked\r\n\r\nffffffffffffffff\r\n");
       to.say_for_ever(kLong);
     }},
    {"body_of_huge_length",
     [](const Peer& to) {
       to.say(std::string(kOk) + "Content-Length: 18446744073709551615\r\n\r\n");
       to.say_for_ever(kLong);
     }},
    {"body_of_negative_length",
     [](const Peer& to) { to.say(std::string(kOk) + "Content-Length: -5\r\n\r\n[1,2]"); }},
    {"body_without_a_length_or_end",
     [](const Peer& to) {
       to.say(std::string(kOk) + "\r\n");
       to.say_for_ever("[1,");
     }},
    {"body_shorter_than_told",
     [](const Peer& to) { to.say(std::string(kOk) + "Content-Length: 900\r\n\r\n[1,2,3"); }},
    {"gzip_bomb",
     [](const Peer& to) {
       to.say(std::string(kOk) + "Content-Encoding: gzip\r\nTransfer-Encoding: chunked\r\n\r\n");
       // The head of a member and of a stored block, then zeros: what inflates grows without end.
       to.say("f\r\n\x1f\x8b\x08");
       to.say_for_ever(std::string(4096, '\0'));
     }},
    {"numbers_that_are_none", [](const Peer& to) { to.say(answer("[nan,0,0,0,0,0,0]")); }},
    {"numbers_beyond_all", [](const Peer& to) { to.say(answer("[0,0,1e308,0,0,0,0]")); }},
    {"numbers_beyond_a_double", [](const Peer& to) { to.say(answer("[0,0,1e999,0,0,0,0]")); }},
    {"nested_json", [](const Peer& to) { to.say(answer(std::string(4000, '['))); }},
    {"redirect_to_itself",
     [](const Peer& to) {
       to.say("HTTP/1.1 302 Found\r\nLocation: /data/odometry\r\nContent-Length: 0\r\n\r\n");
     }},
    {"redirect_to_a_file",
     [](const Peer& to) {
       to.say("HTTP/1.1 301 Moved\r\nLocation: file:///etc/passwd\r\nContent-Length: 0\r\n\r\n");
     }},
    {"request_for_a_password",
     [](const Peer& to) {
       to.say("HTTP/1.1 401 No\r\nWWW-Authenticate: Digest realm=a\r\nContent-Length: 0\r\n\r\n");
     }},
    {"trickle_of_a_head", [](const Peer& to) { to.say_for_ever("H", 100ms); }},
    {"trickle_of_a_body",
     [](const Peer& to) {
       to.say(std::string(kOk) + "Content-Length: 4000\r\n\r\n");
       to.say_for_ever(" ", 100ms);
     }},
    {"silence", [](const Peer& to) { to.say_nothing(); }},
    {"closes_at_once", [](const Peer&) {}},
    {"resets_at_once", [](const Peer& to) { to.reset(); }},
    {"resets_within_the_body",
     [](const Peer& to) {
       to.say(std::string(kOk) + "Content-Length: 100\r\n\r\n[1,");
       to.reset();
     }},
    {"another_protocol", [](const Peer& to) { to.say("SSH-2.0-OpenSSH_9.2\r\n"); }},
    {"nothing_but_zeros", [](const Peer& to) { to.say_for_ever(std::string(60'000, '\0')); }},
};

/// kB, the most that there has been of this process.
long peak_memory() {
  rusage use{};
  ::getrusage(RUSAGE_SELF, &use);
  return use.ru_maxrss;
}

class HostileRobotino : public testing::TestWithParam<Hostile> {};

TEST_P(HostileRobotino, IsAnErrorInTimeAndWithoutMemory) {
  const Device device(GetParam().answer);
  RobotinoRest rest(device.settings());
  const long memory = peak_memory();
  const auto begin = std::chrono::steady_clock::now();
  const auto got = rest.odometry();
  const auto took = std::chrono::steady_clock::now() - begin;
  ASSERT_FALSE(got);
  EXPECT_FALSE(got.error().message.empty());
  EXPECT_LT(took, 1500ms) << "the time-out is 300 ms";
  EXPECT_LT(peak_memory() - memory, 20'000) << got.error().message;
}

INSTANTIATE_TEST_SUITE_P(Modes, HostileRobotino, testing::ValuesIn(kHostile),
                         [](const auto& c) { return std::string(c.param.name); });

TEST(RobotinoRest, NothingIsDecompressed) {
  const Device device(
      [](const Peer& to) { to.say(answer("[0,0,0,0,0,0,0]", "Content-Encoding: gzip\r\n")); });
  EXPECT_TRUE(RobotinoRest(device.settings()).odometry());
}

TEST(RobotinoRest, AnswersInPartsAreRead) {
  const Device device([](const Peer& to) {
    to.say("HTTP/1.1 100 Continue\r\n\r\nHTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\n\r\n");
    for (const char* chunk :
         {"7\r\n[1,2,0.\r\n", "8\r\n5,0,0,0,\r\n", "2\r\n9]\r\n", "0\r\n\r\n"}) {
      to.say(chunk);
      std::this_thread::sleep_for(20ms);
    }
  });
  RobotinoRest rest(device.settings());
  const auto got = rest.odometry();
  ASSERT_TRUE(got) << got.error().message;
  EXPECT_EQ(got->pose.x, 1);
  EXPECT_EQ(got->pose.y, 2);
  EXPECT_EQ(got->sequence, 9);
}

}  // namespace
}  // namespace hal::robot::drivers
