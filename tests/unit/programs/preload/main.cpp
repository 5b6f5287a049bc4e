#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

#include "programs/netns/room_page.h"

/// The dilation of a process is that of its environment when it starts: 0.25, from the clocks'
/// readings 1000, 2000, 3000 and 4000 s. So is its room, a page that nobody has published to.
int main(int argc, char** argv) {
  constexpr const char* kVariable = "BARAKA_DILATION";
  if (std::getenv(kVariable) == nullptr) {
    setenv(kVariable, "0.25 1000000000000 2000000000000 3000000000000 4000000000000", 1);
    const int page = memfd_create("room", 0);
    if (page < 0 || ftruncate(page, sizeof(programs::netns::RoomPage)) != 0) return EXIT_FAILURE;
    setenv(programs::netns::kRoomVariable, ("/proc/self/fd/" + std::to_string(page)).c_str(), 1);
    execv("/proc/self/exe", argv);
    return EXIT_FAILURE;
  }
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
