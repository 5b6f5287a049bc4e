#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "hal/files/config/errors.h"
#include "hal/files/config/loader.h"
#include "hal/files/config/mapping.h"

namespace hal::files::config {

/// A YAML file with everything it includes and the overrides of the command line. Reading is
/// strict: all mistakes are found and reported together.
///
///   Document document = Document::load("robot.yaml", {"mass=2 kg"});
///   Mapping root = document.root();
///   robot.mass = root.number("mass", "kg", {0.1, 100});
///   root.finish();      // reports the keys that were not read
///   document.finish();  // throws if anything was wrong
///
/// `include: other.yaml` in any mapping adds the keys of that file below the mapping's own. The
/// path is relative to the real folder of the including file, after symbolic links; on the command
/// line, to the folder of the first file or, if there is no such file, to the working directory. A
/// file that is not found is searched for in the folders of shared_folders.h, which contain the
/// robots that come with BARAKA. If both set a key, the mapping's own value counts, and mappings
/// are united level by level; but a file included by the command line takes precedence over the
/// including file. A list replaces the list below it; {add: […], remove: […]} changes that list.
///
/// Documents that would exhaust the reader are refused: see document_limits.h.
class Document {
 public:
  /// @param overrides  "dotted.path=value", with the value as written in a file. Later ones take
  ///   precedence over earlier ones. A mapping as value replaces the file's mapping.
  /// @throws ConfigErrors if a file is missing or not YAML, includes form a circle, or an override
  ///   cannot be read.
  static Document load(const std::filesystem::path& file,
                       const std::vector<std::string>& overrides = {});

  ~Document();
  Document(Document&&) noexcept;
  Document& operator=(Document&&) = delete;

  /// The top level. Valid for the life of the document.
  Mapping root();

  /// All included files, directly or indirectly, in the order of reading.
  const std::vector<Included>& included() const;

  /// @throws ConfigErrors with all problems found, sorted by position, if there are any.
  void finish() const;

  /// Values that are permitted but probably unintended, "file:line:column: warning: key: …", sorted
  /// by position.
  std::vector<std::string> warnings() const;

 private:
  struct State;
  explicit Document(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace hal::files::config
