#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace programs::models {

/// Where files that others name are searched for.
class SearchPath {
 public:
  /// The given folders, then those of ROS_PACKAGE_PATH, share of AMENT_PREFIX_PATH,
  /// GZ_SIM_RESOURCE_PATH, IGN_GAZEBO_RESOURCE_PATH and GAZEBO_MODEL_PATH.
  /// @param file  that names others; the folders around it may be the package itself.
  SearchPath(const std::filesystem::path& file, std::vector<std::filesystem::path> given);

  /// The file that a name means: a path, absolute or relative to the folder of the file;
  /// `file://PATH`; `package://NAME/PATH` or `model://NAME/PATH`, PATH in a folder NAME of the
  /// search path, in a folder of it that is called NAME, or in such a folder around the file.
  /// @return nullopt: there is none.
  std::optional<std::filesystem::path> find(const std::string& uri) const;

  /// For messages: "a, b".
  std::string listed() const;

 private:
  std::optional<std::filesystem::path> in_package(const std::string& package,
                                                  const std::filesystem::path& path) const;

  std::filesystem::path folder_;
  std::vector<std::filesystem::path> folders_;
};

}  // namespace programs::models
