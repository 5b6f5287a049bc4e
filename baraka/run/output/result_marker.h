#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace baraka::run::output {

/// The marker file of a run's result folder. It identifies the run and lists every file that the
/// run may write there. A later run moves or removes only these files and the marker.
struct ResultMarker {
  static constexpr const char* kFile = ".baraka-result";

  std::string run;                 ///< Id of the run, 32 hexadecimal digits.
  std::vector<std::string> files;  ///< File names without folders.
};

/// @return a random id, unique to a run.
std::string new_run_id();

/// @pre The folder has no marker. @throws std::runtime_error  the marker cannot be written.
void write_marker(const std::filesystem::path& folder, const ResultMarker& marker);

/// @return none: the folder has no marker. A marker that was cut short lists no files.
std::optional<ResultMarker> read_marker(const std::filesystem::path& folder);

/// Names of files in a folder that no run wrote, sorted. @throws std::filesystem::filesystem_error
std::vector<std::string> foreign_files(const std::filesystem::path& folder);

/// Removes a run's files from a folder, the marker last, and then the folder if it is empty. Links
/// are removed, never followed. @throws std::runtime_error  something cannot be removed.
void remove_result(const std::filesystem::path& folder);

}  // namespace baraka::run::output
