#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "hal/files/config/errors.h"
#include "hal/files/config/shared_folders.h"
#include "sim/scenario/scenario.h"

/// Each file in config/invalid says in its first lines what is wrong with it:
///
///   # set: KEY=VALUE            an override of the command line
///   # expect: line:column: key: what is wrong
///   # expect: parts/other.yaml:line:column: …     in an included file
///   # expect: --set KEY: …                        in an override
///   # expect-check: …           found only with the controller's plug-in, by `baraka check`
///
/// Files in config/doubtful are accepted, with the warnings that their first lines name:
///
///   # warns: line:column: warning: key: what is doubtful
namespace sim::scenario {
namespace {

namespace fs = std::filesystem;
using Lines = std::vector<std::string>;

const fs::path kFolder = fs::path(CONFIG_DIR) / "invalid";
const fs::path kDoubtful = fs::path(CONFIG_DIR) / "doubtful";

std::vector<std::string> files(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// The comments of a file that start with "# <word>: ", without that.
Lines comments(const fs::path& file, const std::string& word) {
  const std::string prefix = "# " + word + ": ";
  std::ifstream stream(file);
  Lines lines;
  for (std::string line; std::getline(stream, line);) {
    if (line.rfind(prefix, 0) == 0) lines.push_back(line.substr(prefix.size()));
  }
  return lines;
}

/// All occurrences of a text taken out.
std::string without(std::string text, const std::string& part) {
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part)) {
    text.erase(at, part.size());
  }
  return text;
}

/// Messages of loading a file as `# expect:` writes them: without the folder, the file's name and
/// the shared folders.
Lines messages(const fs::path& file, const Lines& overrides) {
  try {
    load_scenario(file, overrides);
  } catch (const hal::files::config::ConfigErrors& errors) {
    Lines lines;
    for (const std::string& message : errors.messages()) {
      const std::string own = file.string() + ":";
      const bool is_own = message.rfind(own, 0) == 0;
      const std::string line =
          without(is_own ? message.substr(own.size()) : message, kFolder.string() + "/");
      lines.push_back(without(line, hal::files::config::listed_shared_folders()));
    }
    return lines;
  }
  return {};
}

class InvalidConfig : public testing::TestWithParam<std::string> {};

TEST_P(InvalidConfig, IsRefusedWithTheMessagesItNames) {
  const fs::path file = kFolder / (GetParam() + ".yaml");
  const Lines expected = comments(file, "expect");
  ASSERT_FALSE(expected.empty() && comments(file, "expect-check").empty())
      << file << " does not say what is wrong with it";
  EXPECT_EQ(messages(file, comments(file, "set")), expected);
}

INSTANTIATE_TEST_SUITE_P(Files, InvalidConfig, testing::ValuesIn(files(kFolder)),
                         [](const auto& c) { return c.param; });

class DoubtfulConfig : public testing::TestWithParam<std::string> {};

TEST_P(DoubtfulConfig, IsAcceptedWithTheWarningsItNames) {
  const fs::path file = kDoubtful / (GetParam() + ".yaml");
  const Lines expected = comments(file, "warns");
  ASSERT_FALSE(expected.empty()) << file << " does not say what is doubtful about it";
  Lines warnings;
  for (const std::string& warning : load_scenario(file).warnings) {
    warnings.push_back(without(warning, file.string() + ":"));
  }
  EXPECT_EQ(warnings, expected);
}

INSTANTIATE_TEST_SUITE_P(Files, DoubtfulConfig, testing::ValuesIn(files(kDoubtful)),
                         [](const auto& c) { return c.param; });

// What users start from must load.
TEST(ShippedConfig, Loads) {
  int scenarios = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(CONFIG_DIR) / "scenarios")) {
    EXPECT_EQ(messages(entry.path(), {}), Lines{}) << entry.path();
    EXPECT_EQ(load_scenario(entry.path()).warnings, Lines{}) << entry.path();
    ++scenarios;
  }
  EXPECT_GE(scenarios, 2);
}

TEST(ShippedConfig, RunsTheCaseStudyWithEveryRadioFile) {
  int radios = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(CONFIG_DIR) / "radios")) {
    const fs::path scenario = fs::path(CONFIG_DIR) / "scenarios" / "case_study.yaml";
    EXPECT_EQ(messages(scenario, {"radio.include=" + entry.path().string()}), Lines{})
        << entry.path();
    ++radios;
  }
  EXPECT_GE(radios, 5);
}

TEST(ShippedConfig, RunsTheCaseStudyWithEveryProfile) {
  const fs::path scenario = fs::path(CONFIG_DIR) / "scenarios" / "case_study.yaml";
  for (const char* profile : {"mobility_framework", "ieee80211b", "ieee80211g", "ieee80211n",
                              "ieee80211ac", "ieee80211ax", "disk", "ideal"}) {
    EXPECT_EQ(messages(scenario, {std::string("radio.profile=") + profile}), Lines{});
  }
}

}  // namespace
}  // namespace sim::scenario
