#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "hal/types/message.h"
#include "hal/types/time.h"

namespace results::record {

/// A capture file with one interface whose packets are radiotap before IEEE 802.11 (link type 127),
/// times in nanoseconds: PCAP Next Generation (draft-ietf-opsawg-pcapng). Equal packets give equal
/// bytes. Every member throws std::runtime_error if the file cannot be written; the file then ends
/// with the last packet that fitted, and later packets are dropped.
class PcapngFile {
 public:
  enum class Direction : std::uint8_t { kUnknown, kInbound, kOutbound };

  /// @param file  replaced if it exists.  @param interface  name of the interface in the file.
  PcapngFile(std::filesystem::path file, std::string_view interface);
  ~PcapngFile();  ///< Closes the file without reporting errors: call flush() before.
  PcapngFile(const PcapngFile&) = delete;
  PcapngFile& operator=(const PcapngFile&) = delete;

  void add(hal::Time at, Direction direction, std::span<const std::uint8_t> packet);

  /// Writes what has been added so far, so that others can read it.
  void flush();

 private:
  void append(const std::string& block);
  [[noreturn]] void fail(int error);

  std::filesystem::path file_;
  int descriptor_ = -1;
  std::string buffer_;  ///< Whole blocks.
  std::int64_t written_ = 0;
  bool failed_ = false;
};

}  // namespace results::record
