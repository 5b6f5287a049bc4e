#include "programs/netns/tcp_timers.h"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <string>

#include "programs/netns/descriptor.h"

namespace programs::netns {
namespace {

FileDescriptor table_of(const std::string& lines) {
  FileDescriptor file(memfd_create("table", MFD_CLOEXEC));
  const std::string text =
      "  sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt   uid\n" + lines;
  EXPECT_EQ(write(file.get(), text.data(), text.size()), static_cast<ssize_t>(text.size()));
  return file;
}

std::string line(int number, const std::string& timer) {
  return "   " + std::to_string(number) + ": 0A4D0001:9C40 0A4D0002:0050 01 00000000:00000000 " +
         timer + ":00000013 00000000     0        0 20 1 0000000000000000 20 4 30 10 -1\n";
}

TEST(TcpTimers, AreThoseOfRetransmissionsAndOfClosedWindows) {
  EXPECT_FALSE(has_tcp_timer(table_of("").get()));
  EXPECT_TRUE(has_tcp_timer(table_of(line(0, "01")).get()));
  EXPECT_TRUE(has_tcp_timer(table_of(line(0, "04")).get()));
  for (const char* other : {"00", "02", "03"})  // none, keep-alive, TIME_WAIT
    EXPECT_FALSE(has_tcp_timer(table_of(line(0, other)).get())) << other;
  EXPECT_FALSE(has_tcp_timer(-1));
}

TEST(TcpTimers, AreFoundInTheLastLineOfALongTable) {
  std::string lines;
  for (int i = 0; i < 300; ++i) lines += line(i, "00");
  EXPECT_FALSE(has_tcp_timer(table_of(lines).get()));
  EXPECT_TRUE(has_tcp_timer(table_of(lines + line(300, "01")).get()));
}

}  // namespace
}  // namespace programs::netns
