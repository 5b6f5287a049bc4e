#include "hal/files/recording/bag_metadata.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <stdexcept>
#include <string_view>

#include "hal/files/config/document_limits.h"
#include "hal/files/config/yaml.h"
#include "hal/files/recording/mapped_file.h"
#include "hal/types/printable.h"

namespace hal::files::recording {
namespace {

namespace fs = std::filesystem;
using config::Entry;

[[noreturn]] void refuse_metadata(const config::Place& place, std::string_view what) {
  throw std::runtime_error(fmt::format("{}: {}", place.text(), what));
}

config::Node parse_metadata(const fs::path& path) {
  const MappedFile file(path);
  const Octets octets = file.octets();
  config::Place place;
  place.file = file.name();
  place.line = place.column = 1;
  if (octets.size() > config::kMostBytes)
    refuse_metadata(place, fmt::format("{} bytes are too many", octets.size()));
  std::vector<config::Problem> problems;
  std::size_t values_left = config::kMostValues;
  config::Node root = config::parse_yaml(
      {reinterpret_cast<const char*>(octets.data()), octets.size()}, place, problems, values_left);
  if (!problems.empty()) refuse_metadata(problems.front().place, problems.front().what);
  return root;
}

/// Requires that a value, if there is one, is among those that are known; "" is.
void require(const config::Node& bag, const std::string& key,
             std::initializer_list<std::string_view> known) {
  const Entry* const entry = bag.find(key);
  if (entry == nullptr || entry->value.text.empty()) return;
  std::string names;
  for (const std::string_view one : known) {
    if (entry->value.text == one) return;
    names += fmt::format("{}{}", names.empty() ? "" : " and ", one);
  }
  refuse_metadata(entry->value.place,
                  fmt::format("the {} is {}; {} are known", key,
                              printable(config::kind_name(entry->value)), names));
}

/// A file that metadata.yaml names: relative to its folder; in early versions (1 to 3, and some
/// that converters write) to the folder around that.
fs::path located(const fs::path& folder, const config::Node& name) {
  const fs::path given(name.text);
  for (const fs::path& path : {folder / given, folder / ".." / given, folder / given.filename()}) {
    std::error_code none;
    if (fs::is_regular_file(path, none)) return path.lexically_normal();
  }
  refuse_metadata(name.place, fmt::format("the file {} is missing", printable(name.text)));
}

}  // namespace

BagMetadata read_bag_metadata(const fs::path& path) {
  const config::Node root = parse_metadata(path);
  const Entry* const entry = root.find("rosbag2_bagfile_information");
  if (entry == nullptr || entry->value.kind != config::Node::Kind::kMapping)
    refuse_metadata(root.place.line == 0
                        ? config::Place{.file = printable(path.string()), .line = 1, .column = 1}
                        : root.place,
                    "there is no rosbag2_bagfile_information: it is not of a rosbag2");
  const config::Node& bag = entry->value;
  require(bag, "storage_identifier", {"sqlite3", "mcap"});
  require(bag, "compression_format", {"zstd", "none"});
  BagMetadata metadata;
  const Entry* const files = bag.find("relative_file_paths");
  if (files == nullptr || files->value.items.empty())
    refuse_metadata(bag.place, "relative_file_paths names no file");
  for (const config::Node& name : files->value.items)
    metadata.files.push_back(located(path.parent_path(), name));
  if (const Entry* const count = bag.find("message_count")) {
    std::uint64_t number = 0;
    const std::string& text = count->value.text;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error == std::errc{} && end == text.data() + text.size()) metadata.message_count = number;
  }
  return metadata;
}

}  // namespace hal::files::recording
