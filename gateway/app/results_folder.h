#pragma once

#include <filesystem>

namespace gateway::app {

/// The folder a run writes its results to, held by this process until destruction. An earlier
/// result in it is replaced; a folder with anything else in it is left alone.
class ResultsFolder {
 public:
  /// @throws std::runtime_error  if another run holds it, it has files that are no results, or it
  ///   cannot be written.
  explicit ResultsFolder(std::filesystem::path path);
  ~ResultsFolder();
  ResultsFolder(const ResultsFolder&) = delete;
  ResultsFolder& operator=(const ResultsFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  void lock();
  void clear();

  std::filesystem::path path_;
  int lock_ = -1;
};

}  // namespace gateway::app
