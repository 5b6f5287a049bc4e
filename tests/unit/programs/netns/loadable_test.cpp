#include "programs/netns/loadable.h"

#include <gtest/gtest.h>

#include <fstream>

namespace programs::netns {
namespace {

const std::filesystem::path kStill = std::filesystem::path(BIN_DIR).parent_path() / "tests/still";

class Loadable : public testing::Test {
 protected:
  Loadable() { std::filesystem::create_directories(folder_); }
  ~Loadable() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path file(const std::string& name, const std::string& content) const {
    const auto path = folder_ / name;
    std::ofstream(path) << content;
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    return path;
  }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("baraka-loadable-" + std::to_string(getpid()));
};

TEST_F(Loadable, AreDynamicallyLinkedProgramsOfThisMachineAndTheirScripts) {
  EXPECT_EQ(why_not_preloaded("/proc/self/exe"), std::nullopt);
  EXPECT_EQ(why_not_preloaded("/bin/sh"), std::nullopt);
  EXPECT_EQ(why_not_preloaded(file("script", "#!/bin/sh -e\n")), std::nullopt);
  EXPECT_EQ(why_not_preloaded(kStill), "is statically linked");
  EXPECT_EQ(why_not_preloaded(file("still", "#! " + kStill.string() + "\n")),
            "is run by " + kStill.string() + ", which is statically linked");
  EXPECT_EQ(why_not_preloaded(file("text", "hello\n")), "is neither a program nor a script");
  EXPECT_EQ(why_not_preloaded(file("empty", "")), "is neither a program nor a script");
}

TEST_F(Loadable, AreNotProgramsOfAnotherMachine) {
  std::ifstream self("/proc/self/exe", std::ios::binary);
  std::string head(4096, '\0');
  self.read(head.data(), 4096);
  head[18] = 40;  // e_machine: EM_ARM
  head[19] = 0;
  EXPECT_EQ(why_not_preloaded(file("arm", head)), "is a program of another kind of machine");
  EXPECT_EQ(why_not_preloaded(file("cut", head.substr(0, 20))),
            "is neither a program nor a script");
}

TEST_F(Loadable, AreRefusedOnlyWhereTimeIsSlowed) {
  EXPECT_NO_THROW(require_preloaded(kStill, {}));
  EXPECT_THROW(require_preloaded(kStill, {.factor = 0.5}), std::runtime_error);
  EXPECT_NO_THROW(require_preloaded("/bin/sh", {.factor = 0.5}));
}

TEST_F(Loadable, AreLookedForInTheFoldersOfPath) {
  const auto tool = file("tool", "#!/bin/sh\n");
  EXPECT_EQ(program_file("tool", "/nowhere:" + folder_.string()), tool);
  EXPECT_EQ(program_file(tool.string(), ""), tool);
  EXPECT_THROW(program_file("tool", "/nowhere"), std::runtime_error);
  EXPECT_THROW(program_file("", folder_.string()), std::runtime_error);
  std::filesystem::permissions(tool, std::filesystem::perms::owner_read);
  EXPECT_THROW(program_file("tool", folder_.string()), std::runtime_error);
}

}  // namespace
}  // namespace programs::netns
