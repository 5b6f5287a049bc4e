#include <gtest/gtest.h>

/// Of its own: the library hal_dds brings the main() of controller programs.
int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
