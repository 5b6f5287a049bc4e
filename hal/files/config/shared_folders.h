#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hal::files::config {

/// Where files are looked for that come with BARAKA, like robots: the folders of the environment
/// variable BARAKA_CONFIG_PATH (separated by colons), then ../share/baraka seen from this
/// executable.
std::vector<std::filesystem::path> shared_folders();

/// The first of them that has a file or folder of that relative path; nothing if none has.
std::optional<std::filesystem::path> find_shared(const std::filesystem::path& relative);

/// All of them in one line, for messages: "a, b".
std::string listed_shared_folders();

/// The file that a user means: as given, seen from the current folder; else the first that a shared
/// folder has of that path, in itself or in one of its folders `kinds`. So `case_study.yaml` is
/// found in share/baraka/scenarios, and so is `case_study`: a name without extension means the file
/// `.yaml` if there is none of its own. An absolute path is only itself.
/// @throws ConfigErrors that names every place where it was looked for.
std::filesystem::path named_file(const std::filesystem::path& given,
                                 const std::vector<std::string>& kinds);

/// "; did you mean 'robots/mote.yaml'?" for the file with the nearest name in the folder of `file`,
/// which is not there, or else for those of the same name in folders below a shared one, or for the
/// nearest name in the folder that `relative` names there; nothing if none is near.
/// @param relative  as the user wrote it; empty: shared folders are left out
std::string similar_file(const std::filesystem::path& file,
                         const std::filesystem::path& relative = {});

}  // namespace hal::files::config
