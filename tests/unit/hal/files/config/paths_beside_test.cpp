#include "hal/files/config/paths_beside.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace hal::files::config {
namespace {

namespace fs = std::filesystem;

class PathsBeside : public testing::Test {
 protected:
  PathsBeside() {
    fs::create_directories(folder_ / "bag");
    std::ofstream(folder_ / "lab.mcap") << "x";
  }
  ~PathsBeside() override { fs::remove_all(folder_); }
  std::string of(const std::string& key, const std::string& yaml) const {
    return with_paths_beside(key, yaml, folder_);
  }
  std::string at(const char* name) const { return (folder_ / name).string(); }

  fs::path folder_ = fs::temp_directory_path() / ("paths_beside." + std::to_string(::getpid()));
};

TEST_F(PathsBeside, AreMadeAbsoluteAtAnyDepth) {
  const std::string items =
      of("agents.r.topics", "[{from: lab.mcap, name: lab.mcap}, {from: bag}]");
  EXPECT_NE(items.find("from: " + at("lab.mcap")), std::string::npos) << items;
  EXPECT_NE(items.find("name: lab.mcap"), std::string::npos) << items;
  EXPECT_NE(items.find("from: " + at("bag")), std::string::npos) << items;
  EXPECT_EQ(of("radio.include", "lab.mcap"), at("lab.mcap"));
}

TEST_F(PathsBeside, AreLeftWhereNoSuchFileIs) {
  EXPECT_EQ(of("radio.include", "radios/other.yaml"), "radios/other.yaml");
  EXPECT_EQ(of("radio.include", "bag"), "bag");  // a folder is no file to include
  EXPECT_EQ(of("radio.profile", "ideal"), "ideal");
  EXPECT_EQ(of("seed", "lab.mcap"), "lab.mcap");
  EXPECT_EQ(of("agents.r.topics", "[{from: /lab.mcap"), "[{from: /lab.mcap");  // no YAML
}

}  // namespace
}  // namespace hal::files::config
