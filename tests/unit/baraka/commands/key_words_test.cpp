#include "baraka/commands/key_words.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "baraka/commands/describe_command.h"
#include "baraka/commands/file_kinds.h"

namespace baraka::commands {
namespace {

TEST(KeyWords, APathIsAMappingAndItsLastPart) {
  EXPECT_EQ(last_part("agents.NAME.poses[].m"), "m");
  EXPECT_EQ(mapping_of("agents.NAME.poses[].m"), "agents.NAME.poses[]");
  EXPECT_EQ(last_part("seed"), "seed");
  EXPECT_EQ(mapping_of("seed"), "");
}

TEST(FileKinds, EachHasANameOfItsOwnAndKeys) {
  std::vector<std::string> names;
  for (const FileKind& kind : file_kinds()) {
    names.push_back(kind.name);
    EXPECT_FALSE(kind.about.empty()) << kind.name;
    EXPECT_FALSE(kind.example.empty()) << kind.name;
  }
  EXPECT_GE(names.size(), 4u);
  std::ranges::sort(names);
  EXPECT_EQ(std::ranges::adjacent_find(names), names.end());
}

TEST(KeysPage, HasEveryKindOfFile) {
  const std::string page = keys_page();
  for (const FileKind& kind : file_kinds()) {
    EXPECT_NE(page.find(kind.about), std::string::npos) << kind.name;
  }
}

}  // namespace
}  // namespace baraka::commands
