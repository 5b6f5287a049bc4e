#include "programs/netns/message.h"

#include <gtest/gtest.h>
#include <sys/socket.h>

#include "programs/netns/launch.h"
#include "programs/netns/packed.h"

namespace programs::netns {
namespace {

struct Sockets {
  Sockets() {
    std::array<int, 2> ends{};
    EXPECT_EQ(socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()), 0);
    one.reset(ends[0]);
    other.reset(ends[1]);
  }
  FileDescriptor one, other;
};

TEST(Messages, CarryWhatIsPackedAtAnyLength) {
  const Sockets sockets;
  for (const std::size_t length : {0, 1, 32'000, 40'000, 3'000'000}) {
    Packer out;
    out.put(-5);
    out.put(std::vector<std::string>{"a", std::string(length, 'x'), ""});
    send(sockets.one.get(), MessageKind::kStart, out.bytes());
    const auto message = receive(sockets.other.get());
    ASSERT_TRUE(message);
    EXPECT_EQ(message->kind, MessageKind::kStart);
    Unpacker in(message->content);
    EXPECT_EQ(in.number<int>(), -5);
    EXPECT_EQ(in.texts(), (std::vector<std::string>{"a", std::string(length, 'x'), ""}));
    EXPECT_THROW(in.number(), std::runtime_error);
  }
}

TEST(Messages, CarryDescriptorsInTheirOrder) {
  const Sockets sockets, carried;
  const std::array given{carried.one.get(), carried.other.get()};
  for (const std::size_t length : {10, 100'000}) {
    send(sockets.one.get(), MessageKind::kAgent, std::string(length, 'y'), given);
    const auto message = receive(sockets.other.get());
    ASSERT_EQ(message->descriptors.size(), 2U);
    EXPECT_EQ(message->content, std::string(length, 'y'));
    send(message->descriptors[0].get(), MessageKind::kReady, "here");
    EXPECT_EQ(receive(carried.other.get())->content, "here");
  }
}

TEST(Messages, EndWithTheOtherEndAndItsLastWords) {
  Sockets sockets;
  send(sockets.one.get(), MessageKind::kRefused, "why");
  send(sockets.other.get(), MessageKind::kSetUp, "never read");
  sockets.one.reset();
  EXPECT_EQ(receive(sockets.other.get())->content, "why");
  EXPECT_EQ(receive(sockets.other.get()), std::nullopt);
  EXPECT_THROW(send(sockets.other.get(), MessageKind::kEnd, ""), std::runtime_error);
}

TEST(Environment, InsideKeepsWhatTheUserPreloads) {
  const std::vector<std::string> given{"A=1", "LD_PRELOAD=/mine.so", "A=2"};
  const auto variables = inside(given, "/ours.so", "0.5 1 2 3 4");
  EXPECT_EQ(variables[0], "A=2");
  EXPECT_EQ(variables[1], "LD_PRELOAD=/ours.so:/mine.so");
  EXPECT_EQ(variables[2], "BARAKA_DILATION=0.5 1 2 3 4");
}

}  // namespace
}  // namespace programs::netns
