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
  std::string name;     ///< "scenario": of `baraka describe` and `baraka check --kind`.
  std::string about;    ///< One line for people.
  std::string use;      ///< What takes such a file, "`baraka run FILE` runs it".
  std::string example;  ///< A complete file.
  /// Finds every mistake; says warnings on standard error. @param mode  in which a scenario is run.
  /// @throws hal::files::config::ConfigErrors
  void (*check)(const std::string& path, const std::vector<std::string>& overrides,
                const run::check::RunMode& mode);
  void (*keys)(hal::files::description::Fields&);  ///< Describes its keys.
};

const std::vector<FileKind>& file_kinds();

/// All keys of that kind; found when asked for the first time.
const std::vector<hal::files::config::KeyDescription>& keys_of(const FileKind& kind);

/// The kind that knows the most of the top-level keys of a file.
/// @throws hal::files::config::ConfigErrors if it cannot be read or no single kind knows the most.
const FileKind& recognised(const std::string& path, const std::vector<std::string>& overrides);

}  // namespace baraka::commands
