#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace sim::maps::test {

/// A folder for the files of one test; removed with it.
class Folder {
 public:
  Folder() : path_(std::filesystem::temp_directory_path() / fmt::format("maps-{}", getpid())) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path write(const std::string& name, const std::string& content) const {
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path_ / name;
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// A P5 file of 8 bits. @param rows  the uppermost first
inline std::string pgm(const std::vector<std::string>& rows) {
  std::string file = fmt::format("P5\n{} {}\n255\n", rows.front().size(), rows.size());
  for (const std::string& row : rows) file += row;
  return file;
}

/// The same from drawings: '#' is black, '.' white, '?' the grey of unknown cells.
inline std::string drawn(const std::vector<std::string>& rows) {
  std::vector<std::string> levels = rows;
  for (std::string& row : levels)
    for (char& c : row) c = c == '#' ? '\0' : c == '?' ? '\xCD' : '\xFE';
  return pgm(levels);
}

inline std::string yaml(const std::string& image, const std::string& rest = {}) {
  return fmt::format(
      "image: {}\nresolution: 0.05\norigin: [0.0, 0.0, 0.0]\nnegate: 0\n"
      "occupied_thresh: 0.65\nfree_thresh: 0.196\n{}",
      image, rest);
}

}  // namespace sim::maps::test
