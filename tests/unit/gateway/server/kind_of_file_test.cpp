#include "gateway/server/kind_of_file.h"

#include <gtest/gtest.h>

#include "hal/files/config/errors.h"
#include "tests/unit/hal/files/config/files.h"

namespace gateway::server {
namespace {

using hal::files::config::ConfigErrors;

class KindOfFile : public hal::files::config::Files {
 protected:
  /// What is told of a file in which the mistake "wrong" is found.
  std::vector<std::string> told(const std::filesystem::path& file) {
    return messages(
        [&] { with_hardware_file(file.string(), []() -> int { throw ConfigErrors({"wrong"}); }); });
  }
};

TEST_F(KindOfFile, OfAllThatIsShippedIsToldByItsKeys) {
  int judged = 0;
  for (const auto& [folder, kind] : {std::pair{"scenarios", "scenario"},
                                     {"campaigns", "campaign"},
                                     {"robots", "robot"},
                                     {"radios", "radio"},
                                     {"hardware", "hardware"}}) {
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(CONFIG_DIR) / folder)) {
      const std::string file = entry.path().string();
      if (entry.path().extension() != ".yaml") continue;
      const bool is_mote = kind == std::string("robot") && file.ends_with("mote.yaml");
      const std::string name = is_mote ? "mote" : kind;
      ++judged;
      EXPECT_EQ(told(file),
                name == "hardware"
                    ? std::vector<std::string>{"wrong"}
                    : std::vector<std::string>{file + ": is a " + name +
                                               " file, not a hardware file; " + use_of(name)});
    }
  }
  EXPECT_GT(judged, 20);
}

TEST_F(KindOfFile, IsNotGuessed) {
  EXPECT_EQ(told(write("part.yaml", "version: 1\nradio: {port: 7300}\nwheels: {}\n")),
            std::vector<std::string>{"wrong"});
  EXPECT_EQ(told(write("empty.yaml", "")), std::vector<std::string>{"wrong"});
  EXPECT_EQ(told(folder_ / "nowhere.yaml"), std::vector<std::string>{"wrong"});
}

TEST_F(KindOfFile, IsNotToldWhereNothingIsWrong) {
  EXPECT_EQ(
      with_hardware_file(std::string(CONFIG_DIR) + "/scenarios/wanderer.yaml", [] { return 3; }),
      3);
}

}  // namespace
}  // namespace gateway::server
