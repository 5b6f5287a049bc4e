#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace hal::files::config {

/// All mistakes in a set of files, in the order of their positions. what(): one per line. Control
/// characters of the files are written as \x1b, and very long texts are shortened.
class ConfigErrors : public std::runtime_error {
 public:
  explicit ConfigErrors(std::vector<std::string> messages);

  /// "file:line:column: key: what is wrong"; from the command line: "--set key: what is wrong".
  const std::vector<std::string>& messages() const { return messages_; }

 private:
  std::vector<std::string> messages_;
};

}  // namespace hal::files::config
