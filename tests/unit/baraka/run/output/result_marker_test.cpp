#include "baraka/run/output/result_marker.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "baraka/run/output/folder_lock.h"

namespace baraka::run::output {
namespace {

namespace fs = std::filesystem;

class ResultMarkerTest : public testing::Test {
 protected:
  ResultMarkerTest()
      : folder_(fs::temp_directory_path() / ("baraka_marker_" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~ResultMarkerTest() override { fs::remove_all(folder_); }

  void touch(const std::string& name) const { std::ofstream(folder_ / name) << "x"; }

  const fs::path folder_;
};

TEST_F(ResultMarkerTest, SaysWhichRunMadeTheFolderAndWhatItMayWriteThere) {
  EXPECT_FALSE(read_marker(folder_));
  const ResultMarker marker{.run = new_run_id(), .files = {"run.sqlite", "run.log"}};
  EXPECT_EQ(marker.run.size(), 32u);
  EXPECT_NE(marker.run, new_run_id());
  write_marker(folder_, marker);
  const auto read = read_marker(folder_);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->run, marker.run);
  EXPECT_EQ(read->files, marker.files);
}

TEST_F(ResultMarkerTest, OnlyWhatTheRunWroteIsRemoved) {
  write_marker(folder_, {.run = new_run_id(), .files = {"run.sqlite"}});
  touch("run.sqlite");
  touch("thesis.tex");
  EXPECT_EQ(foreign_files(folder_), std::vector<std::string>{"thesis.tex"});
  remove_result(folder_);
  EXPECT_FALSE(fs::exists(folder_ / "run.sqlite"));
  EXPECT_TRUE(fs::exists(folder_ / "thesis.tex"));
}

TEST_F(ResultMarkerTest, AFolderIsHeldAsLongAsItsLockLives) {
  const fs::path held = folder_ / "result";
  EXPECT_FALSE(is_held(held));
  {
    const FolderLock lock(held);
    EXPECT_TRUE(is_held(held));
  }
  EXPECT_FALSE(is_held(held));
}

}  // namespace
}  // namespace baraka::run::output
