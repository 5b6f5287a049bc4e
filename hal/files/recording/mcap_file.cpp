#include "hal/files/recording/mcap_file.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <stdexcept>

#include "hal/files/recording/compression.h"
#include "hal/files/recording/mcap_record.h"
#include "hal/files/recording/message_size.h"
#include "hal/types/printable.h"

namespace hal::files::recording {
namespace {

constexpr std::array<unsigned char, 8> kMagic = {0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};

std::uint32_t crc_of(Octets octets) {
  return static_cast<std::uint32_t>(
      ::crc32_z(0, reinterpret_cast<const unsigned char*>(octets.data()), octets.size()));
}

void check_crc(std::uint32_t told, Octets octets, std::uint64_t at, std::string_view what) {
  if (told == 0) return;  // not recorded
  const std::uint32_t found = crc_of(octets);
  if (found != told)
    throw FileFault{
        at, fmt::format("the CRC of {} is {:08x}; the file says {:08x}", what, found, told)};
}

class McapReader {
 public:
  McapReader(Octets octets, Collector& into) : octets_(octets), into_(into) {}

  void read();

 private:
  struct Channel {
    std::string name;
    std::size_t topic = 0;
  };

  /// @return the end of the data section. @throws FileFault
  std::uint64_t read_data();
  void read_summary(std::uint64_t data_end);
  void read_header(const McapRecord& record);
  void read_content(const McapRecord& record);
  void read_schema(const McapRecord& record);
  void read_channel(const McapRecord& record);
  void read_message(const McapRecord& record);
  void read_chunk(const McapRecord& record);

  Octets octets_;
  Collector& into_;
  bool is_ros2_ = false;
  std::map<std::uint16_t, std::string> schemas_;
  std::map<std::uint16_t, Channel> channels_;
  std::map<std::string, std::size_t> other_encodings_;  ///< Channels by encoding that is not CDR.
};

void McapReader::read() {
  if (!is_mcap(octets_)) throw FileFault{0, "it is not an MCAP file"};
  read_summary(read_data());
  for (const auto& [encoding, channels] : other_encodings_) {
    into_.note(
        fmt::format("{} channel{} encoded as '{}', not as CDR: the sizes are those in the "
                    "file, without an encapsulation header",
                    channels, channels == 1 ? " is" : "s are", printable(encoding)));
  }
}

std::uint64_t McapReader::read_data() {
  McapRecord record = mcap_record(octets_, kMagic.size());
  if (record.opcode != McapOpcode::kHeader)
    throw FileFault{record.at,
                    fmt::format("a record ({}) comes before the Header", name_of(record.opcode))};
  read_header(record);
  for (;;) {
    record = mcap_record(octets_, record.end());
    switch (record.opcode) {
      case McapOpcode::kChunk:
        read_chunk(record);
        break;
      case McapOpcode::kDataEnd: {
        McapFields fields(record);
        check_crc(fields.u32(), octets_.first(record.at), record.at, "the data section");
        return record.end();
      }
      case McapOpcode::kFooter:
        throw FileFault{record.at, "the Footer comes before a DataEnd"};
      default:
        read_content(record);
    }
  }
}

/// Checks that the file ends as it should. What the summary tells is in the data section, too.
void McapReader::read_summary(std::uint64_t data_end) {
  McapRecord record = mcap_record(octets_, data_end);
  while (record.opcode != McapOpcode::kFooter) record = mcap_record(octets_, record.end());
  McapFields fields(record);
  const std::uint64_t start = fields.u64();
  fields.u64();  // the start of the summary offset section
  const std::uint64_t end = record.at + McapRecord::kHeaderSize + 2 * sizeof(std::uint64_t);
  const std::uint32_t crc = fields.u32();
  if (start != 0 && (start < data_end || start > record.at))
    throw FileFault{record.at, fmt::format("the summary cannot begin at byte {}", start)};
  const std::uint64_t from = start == 0 ? record.at : start;
  check_crc(crc, octets_.subspan(from, end - from), record.at, "the summary section");
  const Octets tail = octets_.subspan(record.end());
  if (tail.size() != kMagic.size() || !is_mcap(tail))
    throw FileFault{record.end(), "the file does not end with MCAP's magic bytes",
                    tail.size() < kMagic.size()};
}

void McapReader::read_header(const McapRecord& record) {
  McapFields fields(record);
  is_ros2_ = fields.text() == "ros2";
  fields.text();  // the library that wrote it
}

void McapReader::read_content(const McapRecord& record) {
  if (record.opcode == McapOpcode::kSchema) read_schema(record);
  if (record.opcode == McapOpcode::kChannel) read_channel(record);
  if (record.opcode == McapOpcode::kMessage) read_message(record);
}

void McapReader::read_schema(const McapRecord& record) {
  McapFields fields(record);
  const std::uint16_t id = fields.u16();
  schemas_[id] = fields.text();
}

void McapReader::read_channel(const McapRecord& record) {
  McapFields fields(record);
  const std::uint16_t id = fields.u16(), schema = fields.u16();
  const std::string name = printable(fields.text());
  const std::string encoding(fields.text());
  const McapRecord map{record.opcode, record.at, fields.take(fields.u32())};
  std::optional<OfferedQos> offered;
  for (McapFields pairs(map); pairs.left() > 0;) {
    const std::string_view key = pairs.text();
    const std::string value(pairs.text());
    if (key != "offered_qos_profiles") continue;
    try {
      offered = read_offered_qos(value);
    } catch (const std::runtime_error& e) {
      fields.refuse(fmt::format("{}: {}", name, e.what()));
    }
  }
  if (const auto known = channels_.find(id); known != channels_.end()) {
    if (known->second.name == name) return;
    fields.refuse(
        fmt::format("it defines channel {} as {}, which is {}", id, name, known->second.name));
  }
  if (schema != 0 && !schemas_.contains(schema))
    fields.refuse(fmt::format("{} is of schema {}, which is not defined", name, schema));
  const bool is_cdr = encoding == "cdr";
  if (!is_cdr) ++other_encodings_[encoding];
  const std::string type = schema == 0 ? "" : printable(schemas_[schema]);
  const std::string full = is_ros2_ || is_cdr ? dds_name(name) : name;
  channels_[id] = {name, into_.topic(full, type, offered)};
}

void McapReader::read_message(const McapRecord& record) {
  McapFields fields(record);
  const auto channel = channels_.find(fields.u16());
  if (channel == channels_.end()) fields.refuse("its channel is not defined");
  fields.u32();  // sequence
  const std::uint64_t logged = fields.u64(), published = fields.u64();
  const std::uint64_t at = published == 0 ? logged : published;
  if (at > std::uint64_t{std::numeric_limits<std::int64_t>::max()})
    fields.refuse(fmt::format("its time is {} ns", at));
  try {
    into_.add(channel->second.topic, static_cast<std::int64_t>(at),
              message_size(fields.take(fields.left())));
  } catch (const std::runtime_error& e) {
    fields.refuse(fmt::format("{}: {}", channel->second.name, e.what()));
  }
}

void McapReader::read_chunk(const McapRecord& record) {
  McapFields fields(record);
  fields.u64();  // times of its first …
  fields.u64();  // … and of its last message
  const std::uint64_t size = fields.u64();
  const std::uint32_t crc = fields.u32();
  const std::string compression = printable(fields.text());
  const Octets compressed = fields.take(fields.u64());
  std::vector<std::byte> content;
  try {
    content = decompressed(compression, compressed, size);
  } catch (const std::runtime_error& e) {
    fields.refuse(e.what());
  }
  check_crc(crc, content, record.at, "the records of the Chunk");
  std::uint64_t at = 0;
  try {
    while (at < content.size()) {
      const McapRecord inner = mcap_record(content, at);
      read_content(inner);
      at = inner.end();
    }
  } catch (const FileFault& fault) {
    throw FileFault{record.at, fmt::format("in the Chunk, at byte {} of its records: {}", fault.at,
                                           fault.what)};
  }
}

}  // namespace

bool is_mcap(Octets octets) {
  return octets.size() >= kMagic.size() &&
         std::ranges::equal(octets.first(kMagic.size()), std::as_bytes(std::span(kMagic)));
}

void read_mcap(const MappedFile& file, Collector& into) {
  const std::size_t before = into.samples();
  try {
    McapReader(file.octets(), into).read();
  } catch (const FileFault& fault) {
    throw std::runtime_error(
        fmt::format("{}: byte {}: {}{}", file.name(), fault.at, fault.what,
                    fault.is_cut ? fmt::format("; {} messages before it are whole: `mcap recover` "
                                               "writes a file of them",
                                               into.samples() - before)
                                 : ""));
  }
}

}  // namespace hal::files::recording
