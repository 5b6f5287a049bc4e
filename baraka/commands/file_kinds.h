#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "baraka/run/check/check_controllers.h"
#include "hal/files/config/key_table.h"
#include "hal/files/description/fields.h"

namespace baraka::commands {

/// A kind of file that BARAKA reads.
struct FileKind {
  std::string name;     ///< Name for `baraka describe` and `baraka check --kind`: "scenario".
  std::string about;    ///< One line for display.
  std::string use;      ///< How such a file is used: "`baraka run FILE` runs it".
  std::string example;  ///< A complete file.
  /// Finds every mistake; prints warnings on standard error.
  /// @param mode  mode in which a scenario would be run.
  /// @throws hal::files::config::ConfigErrors
  void (*check)(const std::string& path, const std::vector<std::string>& overrides,
                const run::check::RunMode& mode);
  void (*keys)(hal::files::description::Fields&);  ///< Describes its keys.
};

const std::vector<FileKind>& file_kinds();

/// All keys of a kind of file; computed at the first call.
const std::vector<hal::files::config::KeyDescription>& keys_of(const FileKind& kind);

/// The kind of file that knows most of a file's top-level keys.
/// @throws hal::files::config::ConfigErrors if the file cannot be read, or several kinds know
/// equally
///   many of its keys.
const FileKind& recognised(const std::string& path, const std::vector<std::string>& overrides);

}  // namespace baraka::commands
