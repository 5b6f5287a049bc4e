#include "hal/robot/radio/udp_link.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <memory>
#include <vector>

#include "hal/node/routing/router.h"
#include "hal/robot/radio/datagram.h"
#include "hal/types/random.h"

namespace hal::robot::radio {
namespace {

using namespace std::chrono_literals;

constexpr Duration kPatience = 30s;  // of the wall clock: reached by a failing test only

sockaddr_in address(const std::string& text, std::uint16_t port) {
  sockaddr_in in{};
  in.sin_family = AF_INET;
  in.sin_port = htons(port);
  inet_pton(AF_INET, text.c_str(), &in.sin_addr);
  return in;
}

/// A socket of somebody else.
class Stranger {
 public:
  explicit Stranger(const std::string& own, std::uint16_t port = 0)
      : socket_(::socket(AF_INET, SOCK_DGRAM, 0)) {
    const int on = 1;
    setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    setsockopt(socket_, IPPROTO_IP, IP_RECVTOS, &on, sizeof on);
    const sockaddr_in in = address(own, port);
    EXPECT_EQ(bind(socket_, reinterpret_cast<const sockaddr*>(&in), sizeof in), 0);
  }
  ~Stranger() { close(socket_); }
  Stranger(const Stranger&) = delete;
  Stranger& operator=(const Stranger&) = delete;

  void send(const Bytes& bytes, const std::string& to, std::uint16_t port) const {
    const sockaddr_in in = address(to, port);
    ASSERT_EQ(sendto(socket_, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&in),
                     sizeof in),
              static_cast<ssize_t>(bytes.size()));
  }

  /// Type of service (DSCP and ECN) of the next datagram that comes; -1: it was not told.
  int next_tos() const {
    pollfd arrival{.fd = socket_, .events = POLLIN, .revents = 0};
    if (poll(&arrival, 1, static_cast<int>(kPatience / 1ms)) != 1) return -1;
    Bytes datagram(kDatagramHeader + kMaxFrame), control(CMSG_SPACE(sizeof(int)));
    iovec content{datagram.data(), datagram.size()};
    msghdr message{};
    message.msg_iov = &content;
    message.msg_iovlen = 1;
    message.msg_control = control.data();
    message.msg_controllen = control.size();
    if (recvmsg(socket_, &message, 0) < 0) return -1;
    const cmsghdr* const told = CMSG_FIRSTHDR(&message);
    if (told == nullptr || told->cmsg_type != IP_TOS) return -1;
    return *CMSG_DATA(told);
  }

 private:
  int socket_;
};

/// Three nodes on one network: the agents 1, 2, 3 at 127.0.77.1, .2, .3.
class UdpLinks : public testing::Test {
 protected:
  struct Heard {
    AgentId from;
    Bytes frame;
    bool operator==(const Heard&) const = default;
  };
  struct Node {
    std::unique_ptr<UdpLink> link;
    std::vector<Heard> heard;
  };

  UdpLinks() {
    std::uint16_t port = 0;
    for (std::uint16_t i = 0; i < 3; ++i) {
      nodes_[i].link = std::make_unique<UdpLink>(config(i + 1, port), loop_);
      nodes_[i].link->attach([this, i](const node::routing::Reception& reception, auto frame) {
        nodes_[i].heard.push_back({reception.from, {frame.begin(), frame.end()}});
      });
      port = nodes_[0].link->port();
    }
  }

  static UdpLinkConfig config(int agent, std::uint16_t port) {
    return {.self = AgentId{static_cast<std::uint16_t>(agent)},
            .interface = "lo",
            .address = "127.0.77." + std::to_string(agent),
            .port = port,
            .bit_rate = 1e6,
            .power = 0.1};
  }

  UdpLink& link(int agent) { return *nodes_[agent - 1].link; }
  std::vector<Heard>& heard(int agent) { return nodes_[agent - 1].heard; }
  std::uint16_t port() { return link(1).port(); }

  template <class Condition>
  [[nodiscard]] bool until(Condition condition) {
    const Time end = loop_.now() + kPatience;
    while (!condition() && loop_.now() < end) loop_.run_once(10ms);
    return condition();
  }

  platform::EventLoop loop_;
  Node nodes_[3];
};

TEST_F(UdpLinks, ABroadcastReachesEveryoneButItsSender) {
  link(1).transmit(kEveryone, {7, 8}, 1);
  ASSERT_TRUE(until(
      [&] { return heard(2).size() == 1 && heard(3).size() == 1 && link(1).counts().own == 1; }));
  EXPECT_EQ(heard(2), (std::vector<Heard>{{AgentId{1}, {7, 8}}}));
  EXPECT_EQ(heard(3), heard(2));
  EXPECT_TRUE(heard(1).empty());
}

// The DSCP is what the network sees; the drivers of 802.11 take the access category from it.
TEST_F(UdpLinks, APriorityIsTheClassSelectorOfTheDatagram) {
  const Stranger listener("127.255.255.255", port());
  link(1).transmit(kEveryone, {1}, 1);
  EXPECT_EQ(listener.next_tos(), 0);
  constexpr int kCs1 = 8, kCs7 = 56, kEcnBits = 2;  // code points: RFC 2474, 4.2.2.2
  link(1).transmit(kEveryone, {2}, {2, Priority::kBackground});
  EXPECT_EQ(listener.next_tos(), kCs1 << kEcnBits);
  link(1).transmit(kEveryone, {3}, {3, Priority{7}});
  EXPECT_EQ(listener.next_tos(), kCs7 << kEcnBits);
  link(1).transmit(kEveryone, {4}, 4);
  EXPECT_EQ(listener.next_tos(), 0) << "it is that of one datagram";
  ASSERT_TRUE(until([&] { return heard(2).size() == 4; })) << "all of them arrive";
}

TEST_F(UdpLinks, AUnicastReachesTheNeighbourThatWasHeardAndNobodyElse) {
  link(2).transmit(kEveryone, {1}, 1);
  ASSERT_TRUE(until([&] { return heard(1).size() == 1 && heard(3).size() == 1; }));
  link(1).transmit(AgentId{2}, Bytes(kMaxFrame, 9), 2);
  ASSERT_TRUE(until([&] { return heard(2).size() == 1; }));
  EXPECT_EQ(heard(2).front(), (Heard{AgentId{1}, Bytes(kMaxFrame, 9)}));
  link(3).transmit(kEveryone, {2}, 3);  // what comes after it has come: nothing is under way
  ASSERT_TRUE(until([&] { return heard(2).size() == 2; }));
  EXPECT_EQ(heard(3).size(), 1u);
}

TEST_F(UdpLinks, AUnicastToSomebodyNeverHeardIsCounted) {
  link(1).transmit(AgentId{3}, {1}, 1);
  EXPECT_EQ(link(1).counts().unknown_neighbour, 1u);
  EXPECT_EQ(link(1).counts().sent, 0u);
}

TEST_F(UdpLinks, ARadioThatIsOffNeitherSendsNorHears) {
  link(2).set_radio(false);
  link(2).transmit(kEveryone, {1}, 1);
  link(1).transmit(kEveryone, {2}, 1);
  ASSERT_TRUE(until([&] { return heard(3).size() == 1 && link(2).counts().radio_off == 2; }));
  EXPECT_TRUE(heard(2).empty());
  EXPECT_EQ(heard(3).front().from, AgentId{1});
  link(2).set_radio(true);
  link(1).transmit(kEveryone, {3}, 2);
  ASSERT_TRUE(until([&] { return heard(2).size() == 1; }));
  EXPECT_EQ(heard(2).front().frame, Bytes{3});
}

TEST_F(UdpLinks, DatagramsOfGarbageChangeNothingAndAreCounted) {
  constexpr int kGarbage = 96'000, kBurst = 32;
  const Stranger stranger("127.0.77.9");
  RandomStream random(1, "garbage");
  const Bytes good = to_datagram(AgentId{2}, Bytes(20, 1));
  for (int i = 0; i < kGarbage; i += kBurst) {
    for (int j = 0; j < kBurst; ++j) {
      Bytes bytes = good;  // random, or truncated
      if (j % 2 == 0) {
        bytes.resize(random.below(100));
        for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random.next());
      } else {
        bytes.resize(random.below(static_cast<std::uint32_t>(good.size())));
      }
      stranger.send(bytes, "127.0.77.1", port());
    }
    loop_.run_once(Duration::zero());
  }
  ASSERT_TRUE(until([&] { return link(1).counts().malformed == kGarbage; }));
  EXPECT_TRUE(heard(1).empty());
  link(1).transmit(AgentId{2}, {1}, 1);
  EXPECT_EQ(link(1).counts().unknown_neighbour, 1u) << "nobody was learned from garbage";
}

TEST_F(UdpLinks, ADatagramLongerThanAnyFrameIsMalformed) {
  const Stranger stranger("127.0.77.9");
  Bytes bytes = to_datagram(AgentId{2}, Bytes(kMaxFrame, 1));
  bytes.resize(10'000);
  stranger.send(bytes, "127.0.77.1", port());
  EXPECT_TRUE(until([&] { return link(1).counts().malformed == 1; }));
}

TEST_F(UdpLinks, AGoodFrameFromAnotherPortIsForeign) {
  const Stranger stranger("127.0.77.9");
  stranger.send(to_datagram(AgentId{9}, Bytes{1}), "127.0.77.1", port());
  EXPECT_TRUE(until([&] { return link(1).counts().foreign == 1; }));
  EXPECT_TRUE(heard(1).empty());
}

TEST_F(UdpLinks, AnotherNodeWithOurAgentAddressIsNotHeard) {
  const Stranger twin("127.0.77.9", port());
  twin.send(to_datagram(AgentId{1}, Bytes{1}), "127.0.77.1", port());
  EXPECT_TRUE(until([&] { return link(1).counts().address_clashes == 1; }));
  EXPECT_TRUE(heard(1).empty());
}

TEST_F(UdpLinks, DelayAndEnergyFollowFromSizeRateAndPower) {
  // 44 + 10 + 46 = 100 bytes at 1 Mbit/s are 0.8 ms, at 0.1 W 80 uJ.
  link(1).transmit(kEveryone, Bytes(44, 0), 1);
  EXPECT_EQ(link(1).expected_delay(), 800us);
  EXPECT_NEAR(link(1).transmit_energy(44), 80e-6, 1e-12);  // J; rounding
}

TEST_F(UdpLinks, ASecondNodeWithOurAddressAndPortIsRefusedAtTheStart) {
  try {
    const UdpLink second(config(1, port()), loop_);
    FAIL() << "two nodes share an address";
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("127.0.77.1"), std::string::npos) << e.what();
  }
}

TEST_F(UdpLinks, AnInterfaceOrAddressThatIsNotThereIsNamedWithThoseThatAre) {
  for (const auto& [interface, own] :
       {std::pair{"nowhere0", ""}, {"lo", "10.1.2.3"}, {"lo", "not an address"}}) {
    UdpLinkConfig wrong = config(4, port());
    wrong.interface = interface;
    wrong.address = own;
    EXPECT_THROW(UdpLink(wrong, loop_), std::runtime_error) << interface << own;
  }
  UdpLinkConfig wrong = config(4, port());
  wrong.interface = "nowhere0";
  wrong.address.clear();
  try {
    const UdpLink link(wrong, loop_);
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("lo (127.0.0.1)"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace hal::robot::radio
