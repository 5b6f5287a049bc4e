#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "hal/files/config/document.h"
#include "hal/files/config/key.h"
#include "hal/files/config/shared_folders.h"

namespace hal::files::config {

/// Files in a folder of their own that ends with the test.
class Files : public testing::Test {
 protected:
  Files() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) /
              (std::string("baraka_") + test->test_suite_name() + "_" + test->name() + "_" +
               std::to_string(::getpid()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~Files() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    const auto path = folder_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << text;
    return path;
  }

  /// Runs `read` and gives the messages of the errors it throws, without the names of its folder
  /// and of the shared ones.
  template <class Read>
  std::vector<std::string> messages(Read read) const {
    try {
      read();
    } catch (const ConfigErrors& errors) {
      std::vector<std::string> result;
      for (std::string message : errors.messages()) {
        for (const std::string& part : {folder_.string() + "/", listed_shared_folders()}) {
          for (auto at = message.find(part); at != std::string::npos; at = message.find(part)) {
            message.erase(at, part.size());
          }
        }
        result.push_back(message);
      }
      return result;
    }
    return {};
  }

  std::filesystem::path folder_;
};

using Lines = std::vector<std::string>;

/// A key of a test, described somehow.
inline Key key(const std::string& name) { return {name, "Of a test."}; }

}  // namespace hal::files::config
