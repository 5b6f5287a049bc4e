#include "programs/models/search_path.h"

#include <cstdlib>
#include <sstream>

namespace programs::models {
namespace {

namespace fs = std::filesystem;

struct Variable {
  const char* name;
  const char* below;
};
constexpr Variable kVariables[] = {{"ROS_PACKAGE_PATH", ""},
                                   {"AMENT_PREFIX_PATH", "share"},
                                   {"GZ_SIM_RESOURCE_PATH", ""},
                                   {"IGN_GAZEBO_RESOURCE_PATH", ""},
                                   {"GAZEBO_MODEL_PATH", ""}};

std::optional<fs::path> if_there(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error) ? std::optional(path) : std::nullopt;
}

}  // namespace

SearchPath::SearchPath(const fs::path& file, std::vector<fs::path> given)
    : folder_(fs::absolute(file).lexically_normal().parent_path()), folders_(std::move(given)) {
  for (const Variable& variable : kVariables) {
    const char* const value = std::getenv(variable.name);
    std::istringstream list(value == nullptr ? "" : value);
    for (std::string one; std::getline(list, one, ':');)
      if (!one.empty()) folders_.push_back(fs::path(one) / variable.below);
  }
}

std::optional<fs::path> SearchPath::find(const std::string& uri) const {
  const std::size_t scheme = uri.find("://");
  if (scheme == std::string::npos) return if_there(folder_ / uri);
  const std::string rest = uri.substr(scheme + 3);
  if (uri.starts_with("file://")) return if_there(folder_ / rest);
  const std::size_t slash = rest.find('/');
  const std::string package = rest.substr(0, slash);
  if (package.empty()) return std::nullopt;
  return in_package(package, slash == std::string::npos ? "" : rest.substr(slash + 1));
}

std::optional<fs::path> SearchPath::in_package(const std::string& package,
                                               const fs::path& path) const {
  std::vector<fs::path> candidates;
  for (const fs::path& folder : folders_) {
    candidates.push_back(folder / package / path);
    if (folder.filename() == package || folder.parent_path().filename() == package)
      candidates.push_back(folder / path);
  }
  for (fs::path around = folder_; around.has_relative_path(); around = around.parent_path())
    if (around.filename() == package) candidates.push_back(around / path);
  for (const fs::path& one : candidates)
    if (auto found = if_there(one)) return found;
  return std::nullopt;
}

std::string SearchPath::listed() const {
  std::string list;
  for (const fs::path& folder : folders_) list += (list.empty() ? "" : ", ") + folder.string();
  return list.empty() ? "no folder" : list;
}

}  // namespace programs::models
