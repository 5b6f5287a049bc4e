#include "results/report/mcap_writer.h"

#include <algorithm>
#include <array>
#include <utility>

#include "results/report/little_endian.h"

namespace results::report {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kMagic = "\x89MCAP0\r\n"sv;

enum Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0b,
  kMetadata = 0x0c,
  kMetadataIndex = 0x0d,
  kSummaryOffset = 0x0e,
  kDataEnd = 0x0f,
};

template <class Number>
void put_number(std::string& bytes, Number value) {
  append_little_endian(bytes, value);
}

/// A text, a map or an array: the number of its bytes, then the bytes.
void put_counted(std::string& bytes, std::string_view content) {
  put_number(bytes, static_cast<std::uint32_t>(content.size()));
  bytes += content;
}

std::string map_of(const McapWriter::Texts& texts) {
  std::string map;
  for (const auto& [key, value] : texts) {
    put_counted(map, key);
    put_counted(map, value);
  }
  return map;
}

std::string record(Opcode opcode, std::string_view content) {
  std::string bytes;
  bytes.reserve(content.size() + 9);
  put_number(bytes, static_cast<std::uint8_t>(opcode));
  put_number(bytes, std::uint64_t{content.size()});
  bytes += content;
  return bytes;
}

}  // namespace

void McapWriter::Span::add(std::uint64_t at_ns) {
  first_ns = messages == 0 ? at_ns : std::min(first_ns, at_ns);
  last_ns = std::max(last_ns, at_ns);
  ++messages;
}

McapWriter::McapWriter(std::string_view profile, std::string_view library, Write write,
                       std::size_t chunk_size)
    : write_(std::move(write)), chunk_size_(chunk_size) {
  std::string header;
  put_counted(header, profile);
  put_counted(header, library);
  emit(kMagic);
  emit(record(kHeader, header));
}

std::uint16_t McapWriter::add_schema(std::string_view name, std::string_view encoding,
                                     std::string_view data) {
  std::string content;
  put_number(content, ++schemas_);
  put_counted(content, name);
  put_counted(content, encoding);
  put_counted(content, data);
  const std::string schema = record(kSchema, content);
  chunk_ += schema;
  schema_records_ += schema;
  return schemas_;
}

std::uint16_t McapWriter::add_channel(std::uint16_t schema, std::string_view topic,
                                      std::string_view encoding, const Texts& metadata) {
  const auto number = static_cast<std::uint16_t>(channels_.size() + 1);
  channels_[number] = {};
  std::string content;
  put_number(content, number);
  put_number(content, schema);
  put_counted(content, topic);
  put_counted(content, encoding);
  put_counted(content, map_of(metadata));
  const std::string channel = record(kChannel, content);
  chunk_ += channel;
  channel_records_ += channel;
  return number;
}

void McapWriter::add_message(std::uint16_t channel, std::int64_t at_ns, std::string_view data) {
  const auto at = static_cast<std::uint64_t>(at_ns);
  Channel& of = channels_.at(channel);
  of.in_chunk.push_back({at, chunk_.size()});
  std::string content;
  put_number(content, channel);
  put_number(content, static_cast<std::uint32_t>(of.messages++));
  put_number(content, at);  // recorded
  put_number(content, at);  // published
  content += data;
  chunk_ += record(kMessage, content);
  chunk_span_.add(at);
  total_.add(at);
  if (chunk_.size() >= chunk_size_) end_chunk();
}

void McapWriter::add_metadata(std::string_view name, const Texts& texts) {
  std::string content;
  put_counted(content, name);
  put_counted(content, map_of(texts));
  const std::string metadata = record(kMetadata, content);
  std::string index;
  put_number(index, offset_);
  put_number(index, std::uint64_t{metadata.size()});
  put_counted(index, name);
  metadata_indexes_ += record(kMetadataIndex, index);
  emit(metadata);
  ++metadata_;
}

void McapWriter::emit(std::string_view bytes) {
  crc_.process_bytes(bytes.data(), bytes.size());
  offset_ += bytes.size();
  write_(bytes);
}

void McapWriter::end_chunk() {
  if (chunk_.empty()) return;
  const std::uint64_t begin = offset_, size = chunk_.size();
  std::string content;
  put_number(content, chunk_span_.first_ns);
  put_number(content, chunk_span_.last_ns);
  put_number(content, size);
  boost::crc_32_type chunk_crc;
  chunk_crc.process_bytes(chunk_.data(), chunk_.size());
  put_number(content, std::uint32_t{chunk_crc.checksum()});
  put_counted(content, "");  // no compression
  put_number(content, size);
  content += chunk_;
  emit(record(kChunk, content));
  const std::uint64_t length = offset_ - begin;
  std::uint64_t index_length = 0;
  const std::string places = write_message_indexes(index_length);
  std::string index;
  put_number(index, chunk_span_.first_ns);
  put_number(index, chunk_span_.last_ns);
  put_number(index, begin);
  put_number(index, length);
  put_counted(index, places);
  put_number(index, index_length);
  put_counted(index, "");
  put_number(index, size);  // compressed
  put_number(index, size);
  chunk_indexes_ += record(kChunkIndex, index);
  ++chunks_;
  chunk_.clear();
  chunk_span_ = {};
}

std::string McapWriter::write_message_indexes(std::uint64_t& length) {
  std::string places;
  const std::uint64_t begin = offset_;
  for (auto& [number, channel] : channels_) {
    if (channel.in_chunk.empty()) continue;
    put_number(places, number);
    put_number(places, offset_);
    std::string entries;
    for (const IndexEntry& entry : channel.in_chunk) {
      put_number(entries, entry.at_ns);
      put_number(entries, entry.offset);
    }
    std::string content;
    put_number(content, number);
    put_counted(content, entries);
    emit(record(kMessageIndex, content));
    channel.in_chunk.clear();
  }
  length = offset_ - begin;
  return places;
}

std::string McapWriter::statistics() const {
  std::string content;
  put_number(content, total_.messages);
  put_number(content, schemas_);
  put_number(content, static_cast<std::uint32_t>(channels_.size()));
  put_number(content, std::uint32_t{0});  // attachments
  put_number(content, metadata_);
  put_number(content, chunks_);
  put_number(content, total_.first_ns);
  put_number(content, total_.last_ns);
  std::string counts;
  for (const auto& [number, channel] : channels_) {
    put_number(counts, number);
    put_number(counts, channel.messages);
  }
  put_counted(content, counts);
  return record(kStatistics, content);
}

void McapWriter::write_summary() {
  crc_.reset();
  const std::uint64_t begin = offset_;
  const std::array<std::pair<Opcode, std::string>, 5> groups{{{kSchema, schema_records_},
                                                              {kChannel, channel_records_},
                                                              {kStatistics, statistics()},
                                                              {kChunkIndex, chunk_indexes_},
                                                              {kMetadataIndex, metadata_indexes_}}};
  std::string offsets;
  for (const auto& [opcode, records] : groups) {
    if (records.empty()) continue;
    std::string place;
    put_number(place, static_cast<std::uint8_t>(opcode));
    put_number(place, offset_);
    put_number(place, std::uint64_t{records.size()});
    offsets += record(kSummaryOffset, place);
    emit(records);
  }
  const std::uint64_t offsets_begin = offset_;
  emit(offsets);
  std::string footer;
  put_number(footer, begin);
  put_number(footer, offsets_begin);
  std::string all = record(kFooter, footer + std::string(4, '\0'));
  all.resize(all.size() - 4);
  emit(all);
  std::string crc;
  put_number(crc, std::uint32_t{crc_.checksum()});
  emit(crc);
}

void McapWriter::finish() {
  end_chunk();
  std::string content;
  put_number(content, std::uint32_t{crc_.checksum()});
  emit(record(kDataEnd, content));
  write_summary();
  emit(kMagic);
}

}  // namespace results::report
