#include "gateway/guard/socket_table.h"

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <random>
#include <sstream>

#include "gateway/guard/sending_socket.h"
#include "tests/unit/gateway/guard/udp_socket.h"

namespace gateway::guard {
namespace {

constexpr const char* kRest = " 00000000:0000 07 00000000:00000000 00:00000000 00000000 ";

/// A line of such a file as Linux 6.1 prints it, but for what is given.
std::string line(const std::string& local, const std::string& user = "1001",
                 const std::string& inode = "97131") {
  return "12874: " + local + kRest + user + "        0 " + inode + " 2 00000000d7b09d6c 0         ";
}

TEST(TableSocket, IsReadFromALineOfTheKernel) {
  const TableSocket expected{0x7f000002, 0xa396, false, 1001, 97131};
  EXPECT_EQ(table_socket(line("0200007F:A396")), expected);
  EXPECT_EQ(table_socket("  " + line("00000000:A396", "4294967294")),
            (TableSocket{0, 0xa396, false, 4294967294, 97131}));
}

TEST(TableSocket, OfIpv6CountsIfItCanSendToIpv4) {
  EXPECT_EQ(table_socket(line("0000000000000000FFFF00000100007F:0007")),
            (TableSocket{0x7f000001, 7, false, 1001, 97131}));
  EXPECT_EQ(table_socket(line("00000000000000000000000000000000:0007")),
            (TableSocket{0, 7, true, 1001, 97131}));
  EXPECT_EQ(table_socket(line("0000000000000000FFFF000000000000:0007")),
            (TableSocket{0, 7, false, 1001, 97131}));
  EXPECT_FALSE(table_socket(line("00000000000000000000000001000000:0007"))) << "::1";
  EXPECT_FALSE(table_socket(line("000080FE000000000000000001000000:0007"))) << "fe80::1";
}

TEST(TableSocket, IsNoneOfAnOddLine) {
  const std::string heading =
      "  sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt   uid  timeout "
      "inode ref pointer drops             ";
  const std::string good = line("0100007F:A396");
  for (const std::string& odd : {heading,
                                 std::string(),
                                 std::string(" "),
                                 std::string("\n"),
                                 std::string(1 << 20, ':'),
                                 std::string("0100007F:A396"),
                                 line("0100007F"),
                                 line("0100007F:"),
                                 line(":A396"),
                                 line("0100007F:A39"),
                                 line("0100007F:0A396"),
                                 line("0100007F:-396"),
                                 line("0100007F:+396"),
                                 line("0100007F:A39G"),
                                 line("0x00007F:A396"),
                                 line("G100007F:A396"),
                                 line("100007F:A396"),
                                 line("00100007F:A396"),
                                 line("0100007F:A396", "-1"),
                                 line("0100007F:A396", "4294967296"),
                                 line("0100007F:A396", "0x3e9"),
                                 line("0100007F:A396", "1001a"),
                                 line("0100007F:A396", "+1"),
                                 line("0100007F:A396", "root"),
                                 line("0100007F:A396", "1001", "-5"),
                                 line("0100007F:A396", "1001", "18446744073709551616"),
                                 line("0100007F:A396", "1001", "x"),
                                 line("0100007F:A396:A396"),
                                 good.substr(0, good.find(" 1001")),
                                 good.substr(0, good.find("97131")),
                                 std::string("1: \0", 4) + good}) {
    EXPECT_FALSE(table_socket(odd)) << odd.substr(0, 100);
  }
}

std::size_t words_in(const std::string& text) {
  std::istringstream words(text);
  std::size_t count = 0;
  for (std::string word; words >> word;) ++count;
  return count;
}

TEST(TableSocket, OfAnyBytesIsReadWithoutHarmAndOnlyFromLinesWithAllColumns) {
  std::mt19937 random(1);
  const std::string good = line("0100007F:A396");
  int found = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::string mutated = good.substr(0, random() % (good.size() + 1));
    for (std::size_t changes = random() % 4; changes > 0 && !mutated.empty(); --changes) {
      mutated[random() % mutated.size()] = static_cast<char>(random());
    }
    const auto socket = table_socket(mutated);
    if (!socket) continue;
    ++found;
    EXPECT_GE(words_in(mutated), 10U) << mutated;
  }
  EXPECT_GT(found, 0);
}

TEST(SocketsWith, AreThoseOfAPort) {
  std::istringstream udp(line("0100007F:0007", "1", "10") + "\n" +
                         line("0200007F:0007", "2", "11") + "\n" + line("0100007F:0008", "3") +
                         "\n" + line("0100007F:0070", "4") + "\nodd :0007 line\n");
  std::istringstream udp6(line("00000000000000000000000000000000:0007", "5", "12"));
  const auto found = sockets_with(7, udp, udp6);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].user, 1U);
  EXPECT_EQ(found[1].user, 2U);
  EXPECT_EQ(found[2].user, 5U);
}

TEST(SocketsBehind, AreWhoHasThePort) {
  std::optional<guard::UdpSocket> socket(std::in_place);
  const UdpSender sender = socket->sender();
  const auto found = sockets_behind(sender);
  ASSERT_TRUE(found);
  ASSERT_EQ(found->size(), 1U);
  EXPECT_EQ(found->front().user, geteuid());
  EXPECT_EQ(found->front().address, INADDR_LOOPBACK);
  socket.reset();
  ASSERT_TRUE(sockets_behind(sender));
  EXPECT_TRUE(sockets_behind(sender)->empty());
}

/// @return whether a port can be had at another address of this host, as somebody would who means
/// to
///   speak in the name of who has it at 127.0.0.1.
bool can_be_shared(std::uint16_t port, int& descriptor) {
  descriptor = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK + 1);
  return bind(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
}

TEST(SocketsBehind, AreAllWhoCanNameTheSenderAsTheSource) {
  const guard::UdpSocket socket;
  int descriptor = -1;
  ASSERT_TRUE(can_be_shared(socket.sender().port, descriptor));
  EXPECT_EQ(sockets_behind(socket.sender())->size(), 2U);
  close(descriptor);
}

TEST(SendingSocket, HasAPortThatNobodyShares) {
  const SendingSocket socket;
  int descriptor = -1;
  EXPECT_FALSE(can_be_shared(socket.port(), descriptor));
  EXPECT_EQ(errno, EADDRINUSE);
  close(descriptor);
  EXPECT_EQ(sockets_behind({INADDR_LOOPBACK, socket.port()})->size(), 1U);
}

TEST(SendingSocket, HoldsNothingOfWhatIsSentToIt) {
  const SendingSocket socket;
  const guard::UdpSocket other;
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(socket.port());
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  for (int i = 0; i < 3; ++i) {
    ASSERT_EQ(sendto(other.descriptor(), "abc", 3, 0, reinterpret_cast<const sockaddr*>(&address),
                     sizeof(address)),
              3);
  }
  char octet = 0;
  EXPECT_LT(recv(socket.number(), &octet, 1, MSG_DONTWAIT), 0);
  EXPECT_EQ(errno, EAGAIN);
}

}  // namespace
}  // namespace gateway::guard
