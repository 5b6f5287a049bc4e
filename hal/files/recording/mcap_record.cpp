#include "hal/files/recording/mcap_record.h"

#include <fmt/format.h>

#include <array>

namespace hal::files::recording {
namespace {

constexpr std::array<std::string_view, 16> kNames = {
    "unknown",  "Header",        "Footer",        "Schema",     "Channel",         "Message",
    "Chunk",    "MessageIndex",  "ChunkIndex",    "Attachment", "AttachmentIndex", "Statistics",
    "Metadata", "MetadataIndex", "SummaryOffset", "DataEnd"};

}  // namespace

std::string_view name_of(McapOpcode opcode) {
  const auto index = static_cast<std::size_t>(opcode);
  return index < kNames.size() ? kNames[index] : kNames[0];
}

McapRecord mcap_record(Octets octets, std::uint64_t at) {
  const Octets rest = octets.subspan(at);
  rtps::Cursor cursor(rest, rtps::Endianness::kLittle);
  McapRecord record{.opcode = static_cast<McapOpcode>(cursor.u8()), .at = at, .content = {}};
  const std::uint64_t length = cursor.u64();
  if (cursor.is_short())
    throw FileFault{at,
                    fmt::format("the file ends: {} of the {} bytes before a record are there",
                                rest.size(), McapRecord::kHeaderSize),
                    true};
  if (length > cursor.left())
    throw FileFault{at,
                    fmt::format("the file ends within a record ({}): {} of its {} bytes are there",
                                name_of(record.opcode), cursor.left(), length),
                    true};
  record.content = rest.subspan(McapRecord::kHeaderSize, length);
  return record;
}

std::string_view McapFields::text() {
  const Octets taken = take(u32());
  return {reinterpret_cast<const char*>(taken.data()), taken.size()};
}

Octets McapFields::take(std::uint64_t count) { return whole(cursor_.take(count)); }

void McapFields::refuse(std::string_view what) const {
  throw FileFault{record_.at, fmt::format("{} of {} bytes: {}", name_of(record_.opcode),
                                          record_.content.size(), what)};
}

}  // namespace hal::files::recording
