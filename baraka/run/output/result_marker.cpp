#include "baraka/run/output/result_marker.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/random.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace baraka::run::output {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kRun = "run: ", kItem = "- ";

/// Markers may come from anywhere: a name that leads out of the folder is not one of a run's files.
bool is_plain_name(std::string_view name) {
  return !name.empty() && name != "." && name != ".." && name.find('/') == std::string_view::npos;
}

[[noreturn]] void fail(const fs::path& path) {
  throw std::runtime_error(fmt::format("{}: {}", path.string(), std::strerror(errno)));
}

void unlink_if_there(const fs::path& file) {
  if (::unlink(file.c_str()) != 0 && errno != ENOENT) fail(file);
}

}  // namespace

std::string new_run_id() {
  std::array<std::uint64_t, 2> bits{};
  if (::getrandom(bits.data(), sizeof bits, 0) != sizeof bits) fail("random bits");
  return fmt::format("{:016x}{:016x}", bits[0], bits[1]);
}

void write_marker(const fs::path& folder, const ResultMarker& marker) {
  std::string text =
      "# Of baraka run. A later run may move or remove these files, and nothing else here.\n";
  text += fmt::format("{}{}\nfiles:\n", kRun, marker.run);
  for (const std::string& file : marker.files) text += fmt::format("{}{}\n", kItem, file);
  const fs::path path = folder / ResultMarker::kFile;
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644);
  if (file < 0) fail(path);
  const ssize_t written = ::write(file, text.data(), text.size());
  const int error = written < 0 ? errno : ENOSPC;
  ::close(file);
  if (written == static_cast<ssize_t>(text.size())) return;
  ::unlink(path.c_str());
  errno = error;
  fail(path);
}

std::optional<ResultMarker> read_marker(const fs::path& folder) {
  const fs::path path = folder / ResultMarker::kFile;
  if (!fs::is_regular_file(fs::symlink_status(path))) return std::nullopt;
  std::ifstream in(path);
  ResultMarker marker;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with(kRun)) marker.run = line.substr(kRun.size());
    if (!line.starts_with(kItem)) continue;
    std::string name = line.substr(kItem.size());
    if (is_plain_name(name)) marker.files.push_back(std::move(name));
  }
  return marker;
}

std::vector<std::string> foreign_files(const fs::path& folder) {
  const std::optional<ResultMarker> marker = read_marker(folder);
  std::vector<std::string> foreign;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const bool is_listed =
        marker && (name == ResultMarker::kFile ||
                   std::ranges::find(marker->files, name) != marker->files.end());
    if (!is_listed || fs::is_directory(entry.symlink_status())) foreign.push_back(name);
  }
  std::ranges::sort(foreign);
  return foreign;
}

void remove_result(const fs::path& folder) {
  const std::optional<ResultMarker> marker = read_marker(folder);
  if (marker) {
    for (const std::string& name : marker->files) unlink_if_there(folder / name);
    unlink_if_there(folder / ResultMarker::kFile);
  }
  if (::rmdir(folder.c_str()) != 0 && errno != ENOENT && errno != ENOTEMPTY) fail(folder);
}

}  // namespace baraka::run::output
