#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>

/// The dilation of a process is that of its environment when it starts: 0.25, from the clocks'
/// readings 1000, 2000, 3000 and 4000 s.
int main(int argc, char** argv) {
  constexpr const char* kVariable = "BARAKA_DILATION";
  if (std::getenv(kVariable) == nullptr) {
    setenv(kVariable, "0.25 1000000000000 2000000000000 3000000000000 4000000000000", 1);
    execv("/proc/self/exe", argv);
    return EXIT_FAILURE;
  }
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
