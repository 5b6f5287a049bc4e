#include "hal/files/recording/rosbag2.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "hal/files/recording/bag_metadata.h"
#include "hal/files/recording/compression.h"
#include "hal/files/recording/mcap_file.h"
#include "hal/files/recording/sqlite_bag.h"
#include "hal/types/printable.h"

namespace hal::files::recording {
namespace {

namespace fs = std::filesystem;

bool is_bag_file(const fs::path& path) {
  const fs::path plain = path.extension() == ".zstd" ? path.stem() : path.filename();
  return plain.extension() == ".db3" || plain.extension() == ".mcap";
}

/// Orders bag_2.db3 before bag_10.db3.
bool is_before(const fs::path& a, const fs::path& b) {
  const std::string x = a.filename().string(), y = b.filename().string();
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  std::size_t i = 0;
  while (i < x.size() && i < y.size() && x[i] == y[i]) ++i;
  while (i > 0 && is_digit(x[i - 1])) --i;
  std::uint64_t m = 0, n = 0;
  const auto first = std::from_chars(x.data() + i, x.data() + x.size(), m);
  const auto second = std::from_chars(y.data() + i, y.data() + y.size(), n);
  if (first.ec == std::errc{} && second.ec == std::errc{} && m != n) return m < n;
  return x < y;
}

std::vector<fs::path> bag_files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && is_bag_file(entry.path())) files.push_back(entry.path());
  }
  std::ranges::sort(files, is_before);
  return files;
}

void read_plain(const fs::path& path, const std::string& name, Collector& into) {
  const MappedFile file(path);
  if (is_sqlite(file.octets())) {
    read_sqlite_bag(path, name, into);
  } else if (is_mcap(file.octets())) {
    read_mcap(file, into);
  } else {
    throw std::runtime_error(
        fmt::format("{}: byte 0: it is neither a SQLite database nor an MCAP file", name));
  }
}

}  // namespace

void read_bag_file(const fs::path& path, Collector& into) {
  const std::string name = printable(path.string());
  if (!is_zstd(MappedFile(path).octets())) return read_plain(path, name, into);
  const DecompressedFile plain(path);
  read_plain(plain.path(), name, into);
}

void read_rosbag2(const fs::path& folder_or_metadata, Collector& into) {
  const bool is_folder = fs::is_directory(folder_or_metadata);
  const fs::path metadata_file =
      is_folder ? folder_or_metadata / "metadata.yaml" : folder_or_metadata;
  if (is_folder && !fs::exists(metadata_file)) {
    const std::vector<fs::path> files = bag_files_in(folder_or_metadata);
    if (files.empty())
      throw std::runtime_error(
          fmt::format("{}: the folder has neither a metadata.yaml nor a .db3 or .mcap file: it is "
                      "not a rosbag2",
                      printable(folder_or_metadata.string())));
    for (const fs::path& file : files) read_bag_file(file, into);
    into.note(fmt::format("there is no metadata.yaml: the {} file{} of the folder were read",
                          files.size(), files.size() == 1 ? "" : "s"));
    return;
  }
  const BagMetadata metadata = read_bag_metadata(metadata_file);
  const std::size_t before = into.samples();
  for (const fs::path& file : metadata.files) read_bag_file(file, into);
  const std::size_t found = into.samples() - before;
  if (metadata.message_count && *metadata.message_count != found)
    into.note(fmt::format("metadata.yaml tells of {} messages; the files hold {}",
                          *metadata.message_count, found));
}

}  // namespace hal::files::recording
