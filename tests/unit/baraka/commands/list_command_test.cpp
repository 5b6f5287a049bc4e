#include "baraka/commands/list_command.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace baraka::commands {
namespace {

TEST(FirstSentence, EndsWithItsFullStopAColonOrABracket) {
  EXPECT_EQ(first_sentence("# Two motes\n# that talk. And more.\nversion: 1\n"),
            "Two motes that talk");
  EXPECT_EQ(first_sentence("# A car: two wheels.\n"), "A car");
  EXPECT_EQ(first_sentence("# A car (of 2007) drives.\n"), "A car");
  EXPECT_EQ(first_sentence("# One.\n#   baraka run one\n"), "One");
  EXPECT_EQ(first_sentence("# 1.5 m long\r\n#\r\n# Else\n"), "1.5 m long");
}

TEST(FirstSentence, IsEmptyWithoutAComment) {
  EXPECT_EQ(first_sentence(""), "");
  EXPECT_EQ(first_sentence("version: 1  # one\n"), "");
  EXPECT_EQ(first_sentence("#"), "");
  EXPECT_EQ(first_sentence("#\n# later\n"), "");
}

TEST(FirstSentence, StandsInEveryFileThatIsShipped) {
  for (const std::string& kind : listed_kinds()) {
    if (kind == "controllers") continue;
    const auto folder = std::filesystem::path(CONFIG_DIR) / kind;
    ASSERT_TRUE(std::filesystem::is_directory(folder)) << kind;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().extension() != ".yaml") continue;
      std::ifstream in(entry.path());
      const std::string text{std::istreambuf_iterator<char>(in), {}};
      const std::string said = first_sentence(text);
      EXPECT_GE(said.size(), 12U) << entry.path() << ": " << said;
    }
  }
}

}  // namespace
}  // namespace baraka::commands
