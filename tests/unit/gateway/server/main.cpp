#include <gtest/gtest.h>

/// For the sanitizer: Fast DDS 2.9 deletes one of its own objects as its base class.
extern "C" const char* __asan_default_options() {  // NOLINT(bugprone-reserved-identifier)
  return "new_delete_type_mismatch=0";
}

/// Of its own: the library hal_dds_exchange brings the main() of controller programs.
int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
