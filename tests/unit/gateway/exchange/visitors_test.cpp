#include "gateway/exchange/visitors.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "gateway/guard/speaker_check.h"
#include "tests/unit/gateway/exchange/child.h"
#include "tests/unit/gateway/guard/foreign_socket.h"
#include "tests/unit/gateway/guard/udp_socket.h"

namespace gateway::exchange {
namespace {

Origin origin(std::uint8_t participant, std::uint8_t writer = 2) {
  Origin made;
  made.value[11] = participant;
  made.value[15] = writer;
  return made;
}

hal::node::exchange::Hello hello_of_this_process(const std::string& instance) {
  const process::ProcessIdentity self = process::this_process();
  hal::node::exchange::Hello hello;
  hello.instance = instance;
  hello.host = self.host;
  hello.pid = self.pid;
  hello.pid_start_time = self.start_time;
  return hello;
}

TEST(Visitors, AnInstanceBelongsToTheParticipantThatNamedItFirst) {
  Visitors visitors(nullptr);
  EXPECT_TRUE(visitors.receive(hello_of_this_process("a"), origin(1), std::nullopt));
  EXPECT_TRUE(visitors.receive(hello_of_this_process("a"), origin(1, 3), std::nullopt));
  const auto foreign = visitors.receive(hello_of_this_process("a"), origin(2), std::nullopt);
  ASSERT_FALSE(foreign);
  EXPECT_EQ(foreign.error().message,
            "it says to be instance 'a' of participant 000000000000000000000001");
  EXPECT_EQ(visitors.origin_of("a"), origin(1));
  EXPECT_EQ(visitors.leave(origin(1)), std::vector<std::string>{"a"});
  EXPECT_TRUE(visitors.receive(hello_of_this_process("a"), origin(2), std::nullopt));
}

TEST(Visitors, OneProcessMayNotSayEndlesslyMany) {
  Visitors visitors(nullptr);
  for (std::size_t i = 0; i < Visitors::kMostOfProcess; ++i) {
    ASSERT_TRUE(visitors.receive(hello_of_this_process(std::to_string(i)),
                                 origin(static_cast<std::uint8_t>(i)), std::nullopt));
  }
  EXPECT_EQ(
      visitors.receive(hello_of_this_process("more"), origin(200), std::nullopt).error().message,
      "its process has said 64 Hellos already");
  EXPECT_EQ(visitors.leave(origin(7)).size(), 1);
  EXPECT_TRUE(visitors.receive(hello_of_this_process("more"), origin(200), std::nullopt));
}

TEST(Visitors, SilenceIsTheEndOfProcessesOnOtherHostsOnly) {
  Visitors visitors(nullptr);
  ASSERT_TRUE(visitors.receive(hello_of_this_process("here"), origin(1), std::nullopt));
  hal::node::exchange::Hello there = hello_of_this_process("there");
  there.host = "elsewhere";
  ASSERT_TRUE(visitors.receive(there, origin(2), std::nullopt));
  EXPECT_TRUE(visitors.fall_silent(origin(1)).empty());
  EXPECT_TRUE(visitors.is_silent("here"));
  EXPECT_FALSE(visitors.is_silent("there"));
  EXPECT_EQ(visitors.fall_silent(origin(2)), std::vector<std::string>{"there"});
  EXPECT_TRUE(visitors.origin_of("here"));
}

TEST(Visitors, OfAnotherUserAreNotReceivedWhateverHostTheySayToBeOf) {
  if (geteuid() != 0) GTEST_SKIP() << "needs the right to become another user";
  const guard::ForeignSocket foreign;
  const guard::UdpSocket own;
  const guard::Trust trust;
  Visitors visitors(&trust);
  hal::node::exchange::Hello hello = hello_of_this_process("a");
  for (const std::string& host : {std::string("nowhere"), std::string(), hello.host}) {
    hello.host = host;
    hello.pid = 1;
    const auto received = visitors.receive(hello, origin(1), foreign.sender());
    ASSERT_FALSE(received) << host;
    EXPECT_EQ(received.error().message,
              fmt::format("pid 1 of host '{}' is not heard: user {} has {}", host,
                          guard::ForeignSocket::kUser, foreign.sender().text()));
  }
  EXPECT_FALSE(visitors.origin_of("a"));
  const guard::Trust wide(std::to_string(guard::ForeignSocket::kUser));
  Visitors trusting(&wide);
  hello.host = "nowhere";
  EXPECT_TRUE(trusting.receive(hello, origin(1), foreign.sender()));
  EXPECT_TRUE(visitors.receive(hello, origin(1), own.sender()))
      << "of a container, of the own user";
}

TEST(SpeakerCheck, APortBelongsToTheProcessThatHasIt) {
  const Child child({"sleep"});  // before there is a socket that it could inherit
  const guard::UdpSocket socket;
  const process::ProcessIdentity self = process::this_process();
  const guard::Trust trust;
  EXPECT_TRUE(check_speaker(self, socket.sender(), &trust));
  const auto other = process::start_time_of(child.pid());
  ASSERT_TRUE(other);
  const auto forged =
      guard::check_speaker({self.host, child.pid(), *other}, socket.sender(), &trust);
  ASSERT_FALSE(forged) << "a program must not pass for another one";
  EXPECT_EQ(forged.error().message, fmt::format("pid {} has not the port {} that it speaks from",
                                                child.pid(), socket.sender().text()));
}

TEST(SpeakerCheck, FromNowhereNobodySpeaksUnlessTrustSaysUnverified) {
  const guard::Trust trust, wide("unverified");
  const process::ProcessIdentity self = process::this_process();
  for (const std::string& host : {self.host, std::string("nowhere")}) {
    const process::ProcessIdentity claimed{host, self.pid, self.start_time};
    const auto checked = guard::check_speaker(claimed, std::nullopt, &trust);
    ASSERT_FALSE(checked);
    EXPECT_NE(checked.error().message.find("from where it speaks is not known"), std::string::npos);
    EXPECT_TRUE(check_speaker(claimed, std::nullopt, &wide));
  }
}

TEST(SpeakerCheck, AProcessThatIsNotThereOrIsAnotherOneByNowDoesNotSpeak) {
  const guard::UdpSocket socket;
  const guard::Trust trust;
  process::ProcessIdentity self = process::this_process();
  self.start_time += 1;
  EXPECT_NE(check_speaker(self, socket.sender(), &trust)
                .error()
                .message.find("has started at another time"),
            std::string::npos);
  Child child({"sleep"});
  const process::ProcessIdentity gone{self.host, child.pid(), 1};
  child.signal(SIGKILL);
  child.wait();
  EXPECT_NE(check_speaker(gone, socket.sender(), &trust).error().message.find("does not run"),
            std::string::npos);
  EXPECT_TRUE(check_speaker({"elsewhere", gone.pid, 1}, socket.sender(), &trust))
      << "nothing is known of the pid, and the user is this one";
}

}  // namespace
}  // namespace gateway::exchange
