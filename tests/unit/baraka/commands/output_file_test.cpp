#include "baraka/commands/output_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace baraka::commands {
namespace {

namespace fs = std::filesystem;

class OutputFileTest : public testing::Test {
 protected:
  OutputFileTest() {
    std::string name = (fs::temp_directory_path() / "baraka_output_XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~OutputFileTest() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void put(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
  }
  std::string text(const std::string& name) const {
    std::ifstream file(path(name));
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::ptrdiff_t files() const {
    return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
  }

  fs::path folder_;
};

TEST_F(OutputFileTest, WhatStoodThereStaysUntilTheNewOneIsWhole) {
  put("a.csv", "old");
  {
    OutputFile output(path("a.csv"));
    output.write("half of");
    EXPECT_EQ(text("a.csv"), "old");
  }
  EXPECT_EQ(text("a.csv"), "old");
  EXPECT_EQ(files(), 1) << "what was not finished is left behind";
  write_output(path("a.csv"), "new");
  EXPECT_EQ(text("a.csv"), "new");
  EXPECT_EQ(files(), 1);
}

/// No file of this process grows beyond some bytes, as on a full disk.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : handler_(::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{.rlim_cur = bytes, .rlim_max = before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    ::signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  sighandler_t handler_;
  rlimit before_{};
};

TEST_F(OutputFileTest, ADiskThatFillsUpLeavesWhatStoodThere) {
  put("a.html", "old");
  {
    const FullDisk disk(100'000);
    for (const char* name : {"a.html", "b.html"}) {
      try {
        write_output(path(name), std::string(1'000'000, 'x'));
        FAIL() << name;
      } catch (const std::runtime_error& error) {
        EXPECT_EQ(error.what(), path(name) + ": File too large");
      }
    }
  }
  EXPECT_EQ(text("a.html"), "old");
  EXPECT_EQ(files(), 1);
}

TEST_F(OutputFileTest, ItHasThePermissionsOfTheOneBeforeElseThoseOfNewFiles) {
  const auto mode = [this](const std::string& name) {
    struct stat status {};
    ::stat(path(name).c_str(), &status);
    return status.st_mode & 07777U;
  };
  put("a.csv", "old");
  put("plain.csv", "");
  ::chmod(path("a.csv").c_str(), 0640);
  write_output(path("a.csv"), "new");
  write_output(path("b.csv"), "new");
  EXPECT_EQ(mode("a.csv"), 0640U);
  EXPECT_EQ(mode("b.csv"), mode("plain.csv"));
}

TEST_F(OutputFileTest, ALinkStaysAndWhatItLeadsToIsReplaced) {
  put("real.csv", "old");
  fs::create_symlink("real.csv", path("link.csv"));
  write_output(path("link.csv"), "new");
  EXPECT_TRUE(fs::is_symlink(path("link.csv")));
  EXPECT_EQ(text("real.csv"), "new");
}

TEST_F(OutputFileTest, DevicesAreWrittenAsTheyAre) {
  EXPECT_NO_THROW(write_output("/dev/null", "text"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  try {
    write_output("/dev/full", "text");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "/dev/full: No space left on device");
  }
}

TEST_F(OutputFileTest, AFolderThatIsNotThereIsAnError) {
  EXPECT_THROW(write_output(path("nowhere/a.csv"), "text"), std::runtime_error);
}

}  // namespace
}  // namespace baraka::commands
