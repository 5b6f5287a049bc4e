#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "hal/files/recording/file_fault.h"
#include "hal/files/recording/mapped_file.h"

namespace hal::files::recording {

/// Kinds of records (MCAP format specification, "Records"); those from 0x80 on are private, and
/// readers skip those that they do not know.
enum class McapOpcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kAttachment = 0x09,
  kAttachmentIndex = 0x0a,
  kStatistics = 0x0b,
  kMetadata = 0x0c,
  kMetadataIndex = 0x0d,
  kSummaryOffset = 0x0e,
  kDataEnd = 0x0f,
};

/// "Chunk"; "unknown" for others.
std::string_view name_of(McapOpcode opcode);

/// A record: one byte of opcode, eight of length, and its content.
struct McapRecord {
  static constexpr std::size_t kHeaderSize = 9;
  McapOpcode opcode{};
  std::uint64_t at = 0;  ///< Byte at which it begins.
  Octets content;

  std::uint64_t end() const { return at + kHeaderSize + content.size(); }
};

/// The record at a byte. @throws FileFault  the octets end before it does.
McapRecord mcap_record(Octets octets, std::uint64_t at);

/// Reads the fields of a record, one after another.
class McapFields {
 public:
  explicit McapFields(const McapRecord& record)
      : record_(record), cursor_(record.content, rtps::Endianness::kLittle) {}

  std::uint16_t u16() { return whole(cursor_.u16()); }
  std::uint32_t u32() { return whole(cursor_.u32()); }
  std::uint64_t u64() { return whole(cursor_.u64()); }
  /// A length of four bytes and that number of octets.
  std::string_view text();
  Octets take(std::uint64_t count);
  std::size_t left() const { return cursor_.left(); }
  [[noreturn]] void refuse(std::string_view what) const;

 private:
  template <class T>
  T whole(T value) const {
    if (cursor_.is_short()) refuse("it is too short for its fields");
    return value;
  }

  McapRecord record_;
  rtps::Cursor cursor_;
};

}  // namespace hal::files::recording
