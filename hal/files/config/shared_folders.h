#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hal::files::config {

/// Folders that are searched for files that come with BARAKA, such as robots: the folders in the
/// environment variable BARAKA_CONFIG_PATH (separated by colons), then ../share/baraka relative to
/// this executable.
std::vector<std::filesystem::path> shared_folders();

/// The first of them that has a file or folder with this relative path; nullopt if none has.
std::optional<std::filesystem::path> find_shared(const std::filesystem::path& relative);

/// All shared folders in one line, for messages: "a, b".
std::string listed_shared_folders();

/// The file that a user means: as given, relative to the working directory; otherwise the first
/// with that path in a shared folder or one of its subfolders `kinds`. So `case_study.yaml` is
/// found in share/baraka/scenarios, and so is `case_study`: a name without extension means the file
/// with `.yaml` if no file has the name itself. An absolute path is not searched for.
/// @throws ConfigErrors that names every place that was searched.
std::filesystem::path named_file(const std::filesystem::path& given,
                                 const std::vector<std::string>& kinds);

/// "; did you mean 'robots/mote.yaml'?" for a missing `file`: the file with the nearest name in its
/// folder; otherwise those with the same name in subfolders of a shared folder, or the nearest name
/// in the folder that `relative` denotes there. Empty if no name is near.
/// @param relative  as the user wrote it; empty: shared folders are not searched
std::string similar_file(const std::filesystem::path& file,
                         const std::filesystem::path& relative = {});

}  // namespace hal::files::config
