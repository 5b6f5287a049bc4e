#include "hal/files/recording/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "hal/files/recording/capture.h"
#include "hal/files/recording/capture_file.h"
#include "hal/files/recording/collector.h"
#include "hal/files/recording/compression.h"
#include "hal/files/recording/mapped_file.h"
#include "hal/files/recording/mcap_file.h"
#include "hal/files/recording/rosbag2.h"
#include "hal/files/recording/sqlite_bag.h"
#include "hal/types/printable.h"

namespace hal::files::recording {
namespace {

namespace fs = std::filesystem;

std::string first_octets(Octets octets) {
  std::string text;
  for (const std::byte octet : octets.first(std::min<std::size_t>(octets.size(), 8)))
    text += fmt::format("{}{:02x}", text.empty() ? "" : " ", std::to_integer<unsigned>(octet));
  return text;
}

bool begins_with(Octets octets, std::string_view magic) {
  return octets.size() >= magic.size() &&
         std::ranges::equal(octets.first(magic.size()), std::as_bytes(std::span(magic)));
}

[[noreturn]] void refuse_file(const MappedFile& file, const fs::path& path) {
  const Octets octets = file.octets();
  std::string what = "it is not an MCAP file, a rosbag2, a pcap or a pcapng";
  if (path.extension() == ".mcap") what = "it is not an MCAP file";
  if (path.extension() == ".db3") what = "it is not a SQLite database, as a .db3 of rosbag2 is";
  if (octets.empty()) {
    what += ": it is empty";
  } else if (begins_with(octets, "#ROSBAG V")) {
    what =
        "it is a bag of ROS 1, which is not read: convert it to rosbag2, e.g. by `rosbags-convert`";
  } else if (begins_with(octets, "\x1f\x8b")) {
    what += ": it is compressed by gzip; gunzip it first";
  } else {
    what += ": it begins with " + first_octets(octets);
  }
  throw std::runtime_error(fmt::format("{}: byte 0: {}", file.name(), what));
}

void read_any(const fs::path& path, Collector& into) {
  if (fs::is_directory(path) || path.filename() == "metadata.yaml") return read_rosbag2(path, into);
  const MappedFile file(path);
  const Octets octets = file.octets();
  if (is_mcap(octets)) return read_mcap(file, into);
  if (is_capture(octets)) return read_capture(file, into);
  if (is_sqlite(octets) || is_zstd(octets)) {
    read_bag_file(path, into);
    if (!fs::exists(path.parent_path() / "metadata.yaml"))
      into.note("there is no metadata.yaml beside the file, nor is one needed");
    return;
  }
  refuse_file(file, path);
}

}  // namespace

Recording read_recording(const fs::path& path) {
  Collector collector;
  read_any(path, collector);
  return collector.finish();
}

}  // namespace hal::files::recording
