#pragma once

#include <boost/crc.hpp>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace results::report {

/// Writes an MCAP file, version 0 of the format (mcap.dev, "MCAP Format Specification"): messages
/// in chunks, uncompressed and with checksums, each with an index by time, and a summary at the
/// end.
///
///   McapWriter file("ros2", "baraka", write);
///   const auto schema = file.add_schema("std_msgs/msg/String", "ros2msg", "string data\n");
///   const auto channel = file.add_channel(schema, "/chatter", "cdr", {});
///   file.add_message(channel, at, bytes);
///   file.finish();
///
/// Errors are those of `write`. One thread.
class McapWriter {
 public:
  using Write = std::function<void(std::string_view)>;
  using Texts = std::map<std::string, std::string>;

  /// @param write  receives the file piece by piece.
  /// @param chunk_size  number of bytes of records after which a chunk ends.
  McapWriter(std::string_view profile, std::string_view library, Write write,
             std::size_t chunk_size = kChunkSize);

  /// @return number of the schema or channel, from 1.
  std::uint16_t add_schema(std::string_view name, std::string_view encoding, std::string_view data);
  std::uint16_t add_channel(std::uint16_t schema, std::string_view topic, std::string_view encoding,
                            const Texts& metadata);

  /// @param channel  result of add_channel().
  /// @param at_ns  not negative; need not increase from message to message.
  void add_message(std::uint16_t channel, std::int64_t at_ns, std::string_view data);

  void add_metadata(std::string_view name, const Texts& texts);

  /// Completes the file. Nothing may be added after this.
  void finish();

  std::uint64_t messages() const { return total_.messages; }

 private:
  static constexpr std::size_t kChunkSize = 1 << 20;

  struct Span {
    std::uint64_t messages = 0;
    std::uint64_t first_ns = 0, last_ns = 0;
    void add(std::uint64_t at_ns);
  };
  struct IndexEntry {
    std::uint64_t at_ns, offset;
  };
  struct Channel {
    std::uint64_t messages = 0;
    std::vector<IndexEntry> in_chunk;
  };

  void emit(std::string_view bytes);
  void end_chunk();
  /// @return the offsets of the index of each channel. @param length  receives the length of all
  /// indexes in bytes.
  std::string write_message_indexes(std::uint64_t& length);
  std::string statistics() const;
  void write_summary();

  Write write_;
  std::size_t chunk_size_;
  std::uint64_t offset_ = 0;  ///< Number of bytes written.
  boost::crc_32_type crc_;    ///< Checksum of the bytes written.
  std::string chunk_;         ///< Records of the chunk under construction.
  Span chunk_span_, total_;
  std::map<std::uint16_t, Channel> channels_;
  std::uint16_t schemas_ = 0;
  std::uint32_t chunks_ = 0, metadata_ = 0;
  /// Records of the summary, by kind.
  std::string schema_records_, channel_records_, chunk_indexes_, metadata_indexes_;
};

}  // namespace results::report
