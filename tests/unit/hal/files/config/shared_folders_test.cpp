#include "hal/files/config/shared_folders.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/unit/hal/files/config/files.h"

namespace hal::files::config {
namespace {

namespace fs = std::filesystem;

/// Two folders in BARAKA_CONFIG_PATH.
class NamedFile : public Files {
 protected:
  NamedFile() {
    const std::string folders = (folder_ / "mine").string() + ":" + (folder_ / "ours").string();
    ::setenv("BARAKA_CONFIG_PATH", folders.c_str(), 1);
  }
  ~NamedFile() override { ::unsetenv("BARAKA_CONFIG_PATH"); }
};

TEST_F(NamedFile, ThatIsThereIsItself) {
  write("ours/scenarios/here.yaml", "");
  const fs::path here = write("here.yaml", "");
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  EXPECT_EQ(named_file("here.yaml", {"scenarios"}), "here.yaml");
  fs::current_path(before);
  EXPECT_EQ(named_file(here, {"scenarios"}), here);
}

TEST_F(NamedFile, IsFoundInASharedFolderAndInItsFoldersOfTheKindsAskedFor) {
  const fs::path plain = write("ours/plain.yaml", "");
  const fs::path scenario = write("ours/scenarios/walk.yaml", "");
  const fs::path robot = write("mine/robots/r.yaml", "");
  EXPECT_EQ(named_file("plain.yaml", {"scenarios"}), plain);
  EXPECT_EQ(named_file("walk.yaml", {"scenarios"}), scenario);
  EXPECT_EQ(named_file("scenarios/walk.yaml", {"scenarios"}), scenario);
  EXPECT_EQ(named_file("r.yaml", {"scenarios", "robots"}), robot);
  EXPECT_THROW(named_file("r.yaml", {"scenarios"}), ConfigErrors);
}

TEST_F(NamedFile, WithoutItsExtensionIsFoundHereAndInSharedFolders) {
  const fs::path scenario = write("ours/scenarios/walk.yaml", "");
  EXPECT_EQ(named_file("walk", {"scenarios"}), scenario);
  EXPECT_EQ(named_file("scenarios/walk", {}), scenario);
  EXPECT_THROW(named_file("walk.yml", {"scenarios"}), ConfigErrors);
  write("walk.yaml", "");
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  EXPECT_EQ(named_file("walk", {}), "walk.yaml");
  fs::current_path(before);
  const fs::path bare = write("ours/scenarios/walk", "");
  EXPECT_EQ(named_file("walk", {"scenarios"}), bare) << "one of that very name comes first";
}

TEST_F(NamedFile, OfTheFirstFolderComesBeforeThatOfTheNext) {
  write("ours/scenarios/walk.yaml", "");
  const fs::path mine = write("mine/scenarios/walk.yaml", "");
  EXPECT_EQ(named_file("walk.yaml", {"scenarios"}), mine);
}

TEST_F(NamedFile, ThatIsNowhereIsToldWithEveryPlace) {
  const auto found = messages([] { named_file("wlak.yaml", {"scenarios", "robots"}); });
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found[0].starts_with("wlak.yaml: there is no such file here, nor in ")) << found[0];
  for (const char* place : {"mine, ", "ours, ", "share/baraka or its scenarios, robots"}) {
    EXPECT_NE(found[0].find(place), std::string::npos) << place << " in " << found[0];
  }
}

TEST_F(NamedFile, ThatIsNotThereIsSoughtByItsNameInFoldersBelow) {
  write("ours/robots/burger.yaml", "");
  EXPECT_EQ(similar_file(folder_ / "burger.yaml", "burger.yaml"),
            "; did you mean 'robots/burger.yaml'?");
  EXPECT_EQ(similar_file(folder_ / "burger", "burger"), "; did you mean 'robots/burger.yaml'?");
  write("ours/hardware/burger.yaml", "");
  EXPECT_EQ(similar_file(folder_ / "burger.yaml", "burger.yaml"),
            "; did you mean 'hardware/burger.yaml' or 'robots/burger.yaml'?");
  EXPECT_EQ(similar_file(folder_ / "waffle.yaml", "waffle.yaml"), "");
}

TEST_F(NamedFile, WithAnAbsolutePathIsOnlyItself) {
  EXPECT_EQ(named_file("/nowhere/walk.yaml", {"scenarios"}), "/nowhere/walk.yaml");
}

}  // namespace
}  // namespace hal::files::config
