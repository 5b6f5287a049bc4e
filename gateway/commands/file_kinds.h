#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gateway/run/judge_controllers.h"
#include "hal/config/mapping.h"
#include "hal/config/survey.h"

namespace gateway {

/// A kind of file that BARAKA reads.
struct FileKind {
  std::string name;     ///< "scenario": of `baraka describe` and `baraka check --kind`.
  std::string about;    ///< One line for people.
  std::string use;      ///< What takes such a file, "`baraka run FILE` runs it".
  std::string example;  ///< A complete file.
  void (*read)(hal::config::Mapping);
  /// Finds every mistake; says warnings on standard error. @param way  in which a scenario is run.
  /// @throws hal::config::ConfigErrors
  void (*judge)(const std::string& path, const std::vector<std::string>& overrides,
                const RunWay& way);
};

const std::vector<FileKind>& file_kinds();

/// All keys of that kind. Asked for the first time it takes some tens of milliseconds.
const hal::config::KeyTable& keys_of(const FileKind& kind);

/// The kind that knows the most of the top-level keys of a file.
/// @throws hal::config::ConfigErrors if it cannot be read or no single kind knows the most.
const FileKind& recognised(const std::string& path, const std::vector<std::string>& overrides);

}  // namespace gateway
