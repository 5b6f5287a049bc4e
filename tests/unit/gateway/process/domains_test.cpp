#include "gateway/process/domains.h"

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <deque>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "tests/support/test_domain.h"

namespace gateway::process {
namespace {

/// What the call throws; empty if it does not.
template <class F>
std::string message_of(F&& call) {
  try {
    call();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return {};
}

TEST(Domains, EveryoneGetsAnother) {
  const DomainHold first = take_domain(std::nullopt);
  const DomainHold second = take_domain(std::nullopt);
  EXPECT_NE(first.domain(), second.domain());
  EXPECT_GE(first.domain(), 1);
  EXPECT_LE(second.domain(), 100);
}

TEST(Domains, BusyOneNamesItsHolder) {
  const DomainHold hold = take_domain(std::nullopt);
  const std::string message = message_of([&] { take_domain(hold.domain()); });
  EXPECT_EQ(message, "DDS domain " + std::to_string(hold.domain()) + " is busy: pid " +
                         std::to_string(getpid()) + " (unit_gateway_process_test) holds it");
}

TEST(Domains, FreeAgainWhenItsHolderIsGone) {
  const int domain = test_domain();
  {
    const DomainHold hold = take_domain(domain);
    EXPECT_NE(message_of([&] { take_domain(domain); }), "");
  }
  EXPECT_EQ(take_domain(domain).domain(), domain);
}

TEST(Domains, EightServersShareOneAndTheNinthIsRefused) {
  const int domain = test_domain();
  std::vector<DomainHold> places;
  for (int place = 0; place < kPlaces; ++place) {
    places.push_back(join_domain(domain));
    EXPECT_EQ(places.back().place(), place);
  }
  EXPECT_NE(message_of([&] { join_domain(domain); }), "");
  EXPECT_NE(message_of([&] { take_domain(domain); }), "");
}

TEST(Domains, SimulatorSharesItsDomainWithNobody) {
  const DomainHold hold = take_domain(std::nullopt);
  EXPECT_NE(message_of([&] { join_domain(hold.domain()); }), "");
}

// Whatever lies in the folder for temporary files, by whomever: nothing there is opened.
TEST(Domains, NoFileIsOpenedForThem) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("baraka_domains_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const std::filesystem::path precious = folder / "precious";
  std::ofstream(precious) << "thesis";
  setenv("TMPDIR", folder.c_str(), 1);
  const int domain = test_domain();
  for (int place = 0; place < kPlaces; ++place) {
    std::filesystem::create_symlink(
        precious, folder / fmt::format("baraka-domain-{}-{}.lock", domain, place));
  }
  EXPECT_EQ(take_domain(domain).domain(), domain);
  unsetenv("TMPDIR");
  EXPECT_EQ(std::filesystem::file_size(precious), 6u);
  std::filesystem::remove_all(folder);
}

// Another user's server is seen, too, and named.
TEST(Domains, UsersExcludeEachOther) {
  if (geteuid() != 0) GTEST_SKIP() << "needs the right to become another user";
  const DomainHold hold = take_domain(std::nullopt);
  const pid_t child = fork();
  if (child == 0) {
    constexpr uid_t kNobody = 65534;
    if (setuid(kNobody) != 0) _exit(2);
    const std::string message = message_of([&] { take_domain(hold.domain()); });
    _exit(message.find("pid " + std::to_string(getppid())) != std::string::npos ? 0 : 1);
  }
  int status = -1;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

TEST(Domains, OneWhosePortsAreInUseIsBusy) {
  const int domain = test_domain();
  const int foreign = socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(7400 + 250 * domain + 10 + 2 * 3));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(bind(foreign, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  EXPECT_EQ(message_of([&] { take_domain(domain); }),
            "DDS domain " + std::to_string(domain) + " is busy: its UDP port " +
                std::to_string(7400 + 250 * domain + 16) + " is in use");
  close(foreign);
  EXPECT_EQ(message_of([&] { take_domain(domain); }), "");
}

TEST(Domains, NumbersWithoutPortsAreRefused) {
  EXPECT_EQ(message_of([] { take_domain(233); }), "there is no DDS domain 233: it is 0 to 232");
  EXPECT_NE(message_of([] { join_domain(-1); }), "");
}

bool is_shown(int domain) { return std::ranges::count(domains_shown_by(geteuid()), domain) == 1; }

// A ninth finds no place for a mark, which does not matter while one of the eight is there.
TEST(ShownDomain, IsFoundUntilTheLastOneIsGone) {
  const int domain = test_domain();
  std::deque<ShownDomain> marks;
  for (int i = 0; i < kPlaces + 1; ++i) marks.emplace_back(domain);
  for (; marks.size() > 1; marks.pop_back()) EXPECT_TRUE(is_shown(domain));
  EXPECT_TRUE(is_shown(domain));
  marks.clear();
  EXPECT_FALSE(is_shown(domain));
}

TEST(ShownDomain, KeepsNobodyOut) {
  const int domain = test_domain();
  const ShownDomain mark(domain);
  EXPECT_EQ(take_domain(domain).domain(), domain);
  EXPECT_TRUE(users_in(domain).empty());
}

TEST(ShownDomain, ThatDoesNotExistIsRefused) {
  EXPECT_THROW(ShownDomain(-1), NoSuchDomain);
  EXPECT_THROW(ShownDomain(kLastDomain + 1), NoSuchDomain);
}

TEST(Ports, ServersAreDiscoveredWhereTheStandardSays) {
  // OMG DDSI-RTPS 2.3, 9.6.1.1: 7400 + 250 domain + 10 + 2 participant.
  EXPECT_EQ(discovery_port(0, 0), 7410);
  EXPECT_EQ(discovery_port(7, 3), 9166);
}

TEST(Ports, AControllersPortIsThatOfNoServerInAnyDomain) {
  for (int i = 0; i < 2000; ++i) {
    const int port = free_port();
    ASSERT_GT(port, 0);
    const int offset = (port - 7400) % 250;
    EXPECT_TRUE(port < 7400 || offset > 24) << port;
  }
}

TEST(DefaultDomain, ComesFromTheEnvironmentOrIsOne) {
  unsetenv("BARAKA_DOMAIN");
  EXPECT_EQ(default_domain(), 1);
  setenv("BARAKA_DOMAIN", "42", 1);
  EXPECT_EQ(default_domain(), 42);
  for (const char* wrong : {"x", "4x", "-1", "233", " 4"}) {
    setenv("BARAKA_DOMAIN", wrong, 1);
    EXPECT_NE(message_of([] { default_domain(); }), "") << wrong;
  }
  unsetenv("BARAKA_DOMAIN");
}

}  // namespace
}  // namespace gateway::process
