#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "hal/files/config/document.h"
#include "hal/files/description/body_section.h"

namespace programs::models::test {

using hal::node::devices::RobotDescription;

inline std::string robots() { return std::string(TESTS_DIR) + "/unit/programs/models/robots/"; }

/// A folder that goes with this object.
class Folder {
 public:
  Folder() {
    std::string path = std::filesystem::temp_directory_path() / "baraka_models_XXXXXX";
    path_ = ::mkdtemp(path.data());
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

/// What a robot file with these keys is; the program `baraka-sdf` reads its model.
struct Loaded {
  RobotDescription robot;
  std::vector<std::string> warnings;
};
inline Loaded loaded(const std::string& keys) {
  const Folder folder;
  auto document = hal::files::config::Document::load(folder.write("robot.yaml", keys));
  Loaded result{hal::files::description::read_robot(document.root()), {}};
  document.finish();
  result.warnings = document.warnings();
  return result;
}

/// The messages of such a file that is wrong.
inline std::vector<std::string> mistakes(const std::string& keys) {
  try {
    loaded(keys);
  } catch (const hal::files::config::ConfigErrors& errors) {
    return errors.messages();
  }
  return {};
}

inline std::string with_wheels(const std::string& file) {
  return (file.ends_with(".sdf") ? "sdf: " : "urdf: ") + robots() + file +
         "\nsearch_path: " + robots() + "\ndrive: {left: left_joint, right: right_joint}\n";
}

}  // namespace programs::models::test
