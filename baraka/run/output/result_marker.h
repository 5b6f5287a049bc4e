#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace baraka::run::output {

/// The marker of a folder that a run made for its result: which run, and every file that it may
/// write there. By it a later run knows what it may move or remove: these files and the marker, and
/// nothing else.
struct ResultMarker {
  static constexpr const char* kFile = ".baraka-result";

  std::string run;                 ///< Id of the run, 32 hexadecimal digits.
  std::vector<std::string> files;  ///< Plain names.
};

/// @return an id that no other run has.
std::string new_run_id();

/// @pre the folder has no marker. @throws std::runtime_error  it cannot be written.
void write_marker(const std::filesystem::path& folder, const ResultMarker& marker);

/// @return none: the folder has no marker. One that was cut short names no files.
std::optional<ResultMarker> read_marker(const std::filesystem::path& folder);

/// What is in a folder that no run wrote, by name. @throws std::filesystem::filesystem_error
std::vector<std::string> foreign_files(const std::filesystem::path& folder);

/// Removes what a run wrote into a folder, and the folder if nothing else is in it; the marker
/// last. Links are removed, never followed. @throws std::runtime_error
void remove_result(const std::filesystem::path& folder);

}  // namespace baraka::run::output
