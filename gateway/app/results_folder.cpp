#include "gateway/app/results_folder.h"

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace gateway::app {
namespace {

namespace fs = std::filesystem;

/// Whether a file is one that a run writes.
bool is_result(const fs::path& file) {
  const std::string name = file.filename().string();
  return name == FolderLock::kFile || name.starts_with("run.sqlite") ||
         name == "scenario.resolved.yaml" || file.extension() == ".log";
}

}  // namespace

void make_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) {
    throw std::runtime_error(fmt::format("{}: cannot be made: {}", path.string(), error.message()));
  }
}

ResultsFolder::ResultsFolder(fs::path path) : path_(std::move(path)) {
  make_folder(path_);
  for (const fs::directory_entry& entry : fs::directory_iterator(path_)) {
    if (is_result(entry.path())) continue;
    throw std::runtime_error(fmt::format("{}: not replaced, because {} in it is no result of a run",
                                         path_.string(), entry.path().filename().string()));
  }
  lock_.emplace(path_);
  clear();
}

void ResultsFolder::clear() {
  std::vector<fs::path> old;
  for (const fs::directory_entry& entry : fs::directory_iterator(path_)) {
    if (entry.path().filename() != FolderLock::kFile) old.push_back(entry.path());
  }
  for (const fs::path& file : old) fs::remove(file);
}

}  // namespace gateway::app
