#include "sim/scenario/given_file.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "hal/files/config/shared_folders.h"

namespace sim::scenario {
namespace {

namespace fs = std::filesystem;

/// Folder of the file in "file:line:column", after symbolic links; empty for the command line.
fs::path folder_of(const std::string& place) {
  const std::size_t column = place.rfind(':');
  const std::size_t line = column == std::string::npos ? column : place.rfind(':', column - 1);
  if (line == std::string::npos) return {};
  std::error_code error;
  return fs::weakly_canonical(place.substr(0, line), error).parent_path();
}

/// Where the file is; empty if it is nowhere.
fs::path found(const std::string& text, const std::string& place) {
  const fs::path given(text);
  std::error_code error;
  for (const fs::path& one : {folder_of(place) / given, fs::absolute(given)}) {
    if (fs::exists(one, error)) return fs::weakly_canonical(one, error);
  }
  const auto shared = hal::files::config::find_shared(given);
  return shared ? fs::weakly_canonical(*shared, error) : fs::path{};
}

}  // namespace

void file_key(Fields& io, const Key& key, fs::path& path) {
  std::string text = path.string();
  if (!io.given_text(key, text)) return;
  path = found(text, io.reading()->place(key.name));
  if (path.empty()) {
    io.mistake(key.name, fmt::format("there is no file '{}'{}", text,
                                     hal::files::config::similar_file(
                                         folder_of(io.reading()->place(key.name)) / text, text)));
  }
}

}  // namespace sim::scenario
