#include "baraka/commands/result_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "gateway/process/exit_status.h"

namespace baraka::commands {
namespace {

TEST(ResultFolder, SaysWhatIsNoResult) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "baraka_result_folder";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder / "empty");
  std::ofstream(folder / "run.sqlite") << "x";
  const auto said = [](const std::filesystem::path& given) -> std::string {
    try {
      require_results({given.string()});
      require_result(given.string());
    } catch (const gateway::process::UsageError& e) {
      return e.what();
    }
    return {};
  };
  EXPECT_THAT(said(folder / "nowhere"), testing::HasSubstr("nowhere: there is no such folder"));
  EXPECT_THAT(said(folder / "emtpy/"),
              testing::HasSubstr("emtpy/: there is no such folder; did you mean '" +
                                 (folder / "empty").string() + "'?; name the folder"));
  EXPECT_THAT(said(folder / "run.sqlit"),
              testing::HasSubstr("run.sqlit: there is no such folder; name"))
      << "a file is no folder";
  EXPECT_THAT(said(folder / "empty"), testing::HasSubstr("empty: holds no result"));
  EXPECT_THAT(said(folder / "run.sqlite"),
              testing::EndsWith("and the folder of a result is wanted: " + folder.string()));
  EXPECT_EQ(said(folder), "");
  std::filesystem::create_directories(folder / "empty/one");
  std::ofstream(folder / "empty/one/run.sqlite") << "x";
  EXPECT_THAT(said(folder / "empty"),
              testing::EndsWith("empty: has results in folders of its own; name one, such as " +
                                (folder / "empty/one").string()));
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace baraka::commands
