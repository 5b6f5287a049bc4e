#include "gateway/guard/trust.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "gateway/guard/strangers.h"
#include "tests/support/fake_clock.h"
#include "tests/unit/gateway/guard/foreign_socket.h"
#include "tests/unit/hal/rtps/datagrams.h"

namespace gateway::guard {
namespace {

/// Whether a claim holds in a child process of a user.
template <class Claim>
bool holds_for(uid_t user, const Claim& claim) {
  const pid_t child = fork();
  if (child == 0) _exit(setuid(user) == 0 && claim() ? 0 : 1);
  int status = -1;
  waitpid(child, &status, 0);
  return status == 0;
}

TEST(Trust, IsInTheOwnUserAndRoot) {
  if (geteuid() != 0) GTEST_SKIP() << "needs the right to become another user";
  EXPECT_TRUE(Trust().covers(0));
  for (const uid_t other : {1U, 997U, 1000U, 65534U}) EXPECT_FALSE(Trust().covers(other)) << other;
  EXPECT_TRUE(holds_for(1001, [] {
    const Trust trust;
    return trust.covers(0) && trust.covers(1001) && !trust.covers(1002) && !trust.covers(997) &&
           !trust.covers(65534);
  }));
}

TEST(Trust, NamesOthersByNameOrNumber) {
  const Trust trust("daemon, 1002\n70000");
  for (const uid_t named : {1U, 1002U, 70000U}) EXPECT_TRUE(trust.covers(named)) << named;
  EXPECT_FALSE(trust.covers(1003));
  EXPECT_FALSE(trust.covers_unverified());
  EXPECT_TRUE(Trust("1002,unverified").covers_unverified());
  EXPECT_FALSE(Trust("").covers_unverified());
}

TEST(Trust, RefusesWhoIsNoUser) {
  for (const char* text :
       {"nobody-of-that-name", "4294967295", "-1", "1002 18446744073709551617"}) {
    EXPECT_THROW(Trust{text}, NoSuchUser) << text;
  }
}

TEST(Trust, IsNotInANumberThatStandsForManyUsers) {
  constexpr const char* kAll = "         0          0 4294967295\n";
  EXPECT_TRUE(is_told(1001, 65534, "0 100000 65536\n"));
  EXPECT_TRUE(is_told(65534, 65534, kAll));
  EXPECT_FALSE(is_told(65534, 65534, "0 100000 65536\n"));
  EXPECT_FALSE(is_told(65534, 65534, "0 0 65536\n"));
  EXPECT_FALSE(is_told(65534, 65534, ""));
  EXPECT_FALSE(is_told(7, 7, "garbage"));
}

TEST(JudgeSender, GoesByTheSocket) {
  const UdpSocket own;
  const SenderJudgement judgement = judge_sender(own.sender(), Trust());
  EXPECT_EQ(judgement.objection, "");
  EXPECT_EQ(judgement.user, geteuid());
  EXPECT_NE(judgement.inode, 0U);
}

TEST(JudgeSender, RefusesAnotherUserUnlessTrustNamesIt) {
  if (geteuid() != 0) GTEST_SKIP() << "needs the right to become another user";
  guard::ForeignSocket foreign;
  const SenderJudgement judgement = judge_sender(foreign.sender(), Trust());
  EXPECT_EQ(judgement.user, guard::ForeignSocket::kUser);
  EXPECT_EQ(judgement.objection, "user 65533 has " + foreign.sender().text());
  EXPECT_EQ(judge_sender(foreign.sender(), Trust("65533")).objection, "");
  EXPECT_NE(judge_sender(foreign.sender(), Trust("65532 unverified")).objection, "");
}

TEST(JudgeSender, RefusesWhomItCannotTellUnlessTrustSaysUnverified) {
  UdpSender gone;
  {
    const UdpSocket closed;
    gone = closed.sender();
  }
  EXPECT_EQ(judge_sender(gone, Trust()).objection, "nobody has any more " + gone.text());
  EXPECT_EQ(judge_sender(gone, Trust("unverified")).objection, "");
}

TEST(JudgeSender, RefusesAPortThatAnotherUserSpeaksFromAsWell) {
  if (geteuid() != 0) GTEST_SKIP() << "needs the right to become another user";
  const guard::ForeignSocket foreign;
  const int shared = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(foreign.sender().port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK + 1);
  ASSERT_EQ(bind(shared, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  EXPECT_NE(judge_sender({INADDR_LOOPBACK + 1, foreign.sender().port}, Trust()).objection, "");
  close(shared);
}

class ForeignDatagrams : public testing::Test {
 protected:
  void SetUp() override {
    if (geteuid() != 0) GTEST_SKIP() << "needs the right to become another user";
  }
  static hal::rtps::Datagram announcement() { return hal::rtps::recorded("fast_dds").front(); }
};

TEST_F(ForeignDatagrams, AreRefusedCountedAndToldByUser) {
  tests::FakeClock clock;
  guard::ForeignSocket foreign;
  const UdpSocket own;
  Strangers strangers(Trust(), clock);
  const auto datagram = announcement();
  const auto octets = hal::rtps::octets_of(datagram);
  testing::internal::CaptureStderr();
  EXPECT_FALSE(strangers.refuse(octets, own.sender()));
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(strangers.refuse(octets, foreign.sender()));
  const std::string told = testing::internal::GetCapturedStderr();
  EXPECT_EQ(told.find("user 65533 ("), told.rfind("user 65533 (")) << "told once:\n" << told;
  EXPECT_NE(told.find(fmt::format("user 65533 (pid {} (", foreign.pid())), std::string::npos)
      << told;
  EXPECT_NE(told.find(foreign.sender().text()), std::string::npos) << told;
  ASSERT_EQ(strangers.summary().size(), 1U);
  EXPECT_TRUE(strangers.summary()[0].starts_with("user 65533: 3 datagrams"))
      << strangers.summary()[0];
}

TEST_F(ForeignDatagrams, GetToNoParticipantOfAStar) {
  guard::ForeignSocket foreign;
  const UdpSocket own;
  const auto datagram = announcement();
  const auto octets = hal::rtps::octets_of(datagram);
  const auto filter_with = [](const Trust& trust) {
    return std::make_unique<DatagramFilter>(DatagramFilter::Settings{
        .networks = networks_of({"127.0.0.1"}), .is_star = true, .trust = trust});
  };
  EXPECT_FALSE(filter_with(Trust())->lets_in(octets, foreign.sender()));
  EXPECT_TRUE(filter_with(Trust("65533"))->lets_in(octets, foreign.sender()));
  const auto filter = filter_with(Trust());
  EXPECT_TRUE(filter->lets_in(octets, own.sender()));
  EXPECT_FALSE(filter->lets_in(octets, foreign.sender())) << "in the name of another participant";
  EXPECT_EQ(filter->strangers().size(), 1U);
  EXPECT_EQ(filter->drops(), "");
}

TEST_F(ForeignDatagrams, AreHeardAgainOnceThePortHasComeToATrustedUser) {
  tests::FakeClock clock;
  guard::ForeignSocket foreign;
  Strangers strangers(Trust("unverified"), clock);
  const auto datagram = announcement();
  EXPECT_TRUE(strangers.refuse(hal::rtps::octets_of(datagram), foreign.sender()));
  foreign.end();
  EXPECT_TRUE(strangers.refuse(hal::rtps::octets_of(datagram), foreign.sender()))
      << "a moment later";
  clock.run_until(hal::Time{} + std::chrono::seconds{1});
  EXPECT_FALSE(strangers.refuse(hal::rtps::octets_of(datagram), foreign.sender()));
}

TEST(Attempts, AreWhatDiscoveryTells) {
  std::set<std::string> attempts;
  for (const auto& one : hal::rtps::recorded("fast_dds")) {
    for (std::string& attempt : attempts_in(hal::rtps::octets_of(one))) attempts.insert(attempt);
  }
  // Of a run, its controllers' process "robots" and its inspection.
  const std::set<std::string> expected{"is called 'baraka run'",    "is called 'baraka controller'",
                                       "reads baraka/hello",        "writes baraka/hello",
                                       "reads baraka/session",      "writes baraka/session",
                                       "reads baraka/robots/step",  "writes baraka/robots/step",
                                       "reads baraka/robots/reply", "writes baraka/robots/reply"};
  EXPECT_EQ(attempts, expected);
}

TEST(Attempts, OfAnyBytesAreToldWithoutHarm) {
  for (const auto& one : hal::rtps::recorded("fast_dds")) {
    for (std::size_t size = 0; size < one.size(); ++size) {
      const hal::rtps::Datagram cut(one.begin(), one.begin() + static_cast<std::ptrdiff_t>(size));
      for (const std::string& attempt : attempts_in(hal::rtps::octets_of(cut))) {
        EXPECT_LT(attempt.size(), 100U);
      }
    }
  }
}

}  // namespace
}  // namespace gateway::guard
