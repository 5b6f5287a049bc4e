#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "hal/files/config/errors.h"
#include "hal/files/config/loader.h"
#include "hal/files/config/mapping.h"

namespace hal::files::config {

/// A YAML file with everything it includes and the overrides of the command line, strict: every
/// mistake is found and all are reported at once.
///
///   Document document = Document::load("robot.yaml", {"mass=2 kg"});
///   Mapping root = document.root();
///   robot.mass = root.number("mass", "kg", {0.1, 100});
///   root.finish();      // names the keys nobody asked for
///   document.finish();  // throws if anything was wrong
///
/// `include: other.yaml` in any mapping puts the keys of that file under the mapping's own. The
/// path is relative to the folder that really holds the file it stands in, whatever symbolic links
/// lead there; on the command line, to that of the first file or, failing that, the working
/// directory. A file that is not there is looked for in the folders
/// of shared_folders.h, where the robots that come with BARAKA are. Where both set a key, the
/// mapping's own value counts, mappings being united level by level; but what the command line
/// includes wins over the file. A list replaces the one below; {add: […], remove: […]} changes it.
///
/// What would exhaust a reader is refused: see document_limits.h.
class Document {
 public:
  /// @param overrides  "dotted.path=value", the value as it would stand in the file. Later ones win
  ///   over earlier ones. A mapping on the right replaces the file's.
  /// @throws ConfigErrors if a file is missing or not YAML, an include goes in circles, or an
  ///   override cannot be read.
  static Document load(const std::filesystem::path& file,
                       const std::vector<std::string>& overrides = {});

  ~Document();
  Document(Document&&) noexcept;
  Document& operator=(Document&&) = delete;

  /// The top level. Valid as long as the document.
  Mapping root();

  /// What it includes, and what that does, in the order of reading.
  const std::vector<Included>& included() const;

  /// @throws ConfigErrors with all problems found, sorted by position, if there are any.
  void finish() const;

  /// What is allowed and hardly meant, "file:line:column: warning: key: …", sorted by position.
  std::vector<std::string> warnings() const;

 private:
  struct State;
  explicit Document(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace hal::files::config
