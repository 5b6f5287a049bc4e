#include "programs/netns/user_ids.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace programs::netns {
namespace {

class UserIds : public testing::Test {
 protected:
  UserIds()
      : file_(std::filesystem::path(testing::TempDir()) /
              ("uid_map_" + std::to_string(::getpid()))) {}
  ~UserIds() override { std::filesystem::remove(file_); }

  std::filesystem::path file_;
};

// As the kernel writes it: inside, outside, count.
TEST_F(UserIds, BeneathARunAreThoseOfTheRunUnderTheSameNumbers) {
  std::ofstream(file_) << "         0       1000          1\n         1     100000      65536\n";
  EXPECT_EQ(identity_map(file_.c_str()), "0 0 1\n1 1 65536\n");
}

TEST_F(UserIds, OfAFileThatIsNoMapAreRefused) {
  std::ofstream(file_) << "nonsense\n";
  EXPECT_THROW((void)identity_map(file_.c_str()), std::runtime_error);
}

TEST_F(UserIds, HaveALastGroupInThisProcess) {
  std::ifstream map("/proc/self/gid_map");
  std::uint64_t first = 0, outside = 0, count = 0;
  map >> first >> outside >> count;
  if (first == 0) {
    EXPECT_GE(last_group(), count - 1);
  }
}

}  // namespace
}  // namespace programs::netns
