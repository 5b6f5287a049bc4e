#include "results/report/mcap_writer.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace results::report::test {
namespace {

std::string in_hexadecimal(std::string_view bytes) {
  std::string text;
  for (const char byte : bytes) text += fmt::format("{:02x}", static_cast<std::uint8_t>(byte));
  return text;
}

std::string without_spaces(std::string text) {
  std::erase(text, ' ');
  return text;
}

std::string write_file(const std::function<void(McapWriter&)>& fill, std::size_t chunk_size) {
  std::string bytes;
  McapWriter file(
      "p", "l", [&bytes](std::string_view part) { bytes += part; }, chunk_size);
  fill(file);
  file.finish();
  return bytes;
}

// Worked by hand from "MCAP Format Specification", mcap.dev; the checksums with zlib. A record is
// its opcode (1 byte), the length of its content (8) and the content; a text, a map or an array
// stands behind its length in bytes (4).
TEST(McapWriter, WritesASmallFileByteByByte) {
  const std::string magic = "894d434150300d0a";
  const std::string schema = "03 1100000000000000 0100 010000006e 0100000065 0100000064";
  const std::string channel = "04 1500000000000000 0100 0100 020000002f74 03000000636472 00000000";
  const std::string file =
      magic + "01 0a00000000000000 0100000070 010000006c" +  // header: profile, library
      // At 27: metadata.
      "0c 1300000000000000 010000006d 0a000000 010000006b 0100000076" +
      // At 55: a chunk from 7 to 258 ns, 121 bytes of records, their checksum, no compression.
      "06 a100000000000000 0700000000000000 0201000000000000 7900000000000000 821bc701 00000000 "
      "7900000000000000" +
      schema + channel +
      // Messages: channel, sequence, two times, what it is.
      "05 1800000000000000 0100 00000000 0201000000000000 0201000000000000 6162 05 "
      "1700000000000000 0100 01000000 0700000000000000 0700000000000000 63" +
      // At 225: its index, times and places within the records: 26 + 30 and 33 more.
      "07 2600000000000000 0100 20000000 0201000000000000 3800000000000000 0700000000000000 "
      "5900000000000000" +
      "0f 0400000000000000 65317abe" +  // the end of the data: checksum from byte 0
      // At 285: the summary.
      schema + channel +
      // At 341: 2 messages, 1 schema, 1 channel, 0 attachments, 1 metadata, 1 chunk, 7 to 258 ns.
      "0b 3800000000000000 0200000000000000 0100 01000000 00000000 01000000 01000000 "
      "0700000000000000 0201000000000000 0a000000 0100 0200000000000000" +
      // At 406: the chunk at 55, 170 bytes, the index of channel 1 at 225, 47 bytes.
      "08 4a00000000000000 0700000000000000 0201000000000000 3700000000000000 aa00000000000000 "
      "0a000000 0100 e100000000000000 2f00000000000000 00000000 7900000000000000 7900000000000000" +
      // At 489: the metadata at 27, 28 bytes.
      "0d 1500000000000000 1b00000000000000 1c00000000000000 010000006d" +
      // At 519: where the groups of the summary are, and how long.
      "0e 1100000000000000 03 1d01000000000000 1a00000000000000 0e 1100000000000000 04 "
      "3701000000000000 1e00000000000000 0e 1100000000000000 0b 5501000000000000 4100000000000000 "
      "0e 1100000000000000 08 9601000000000000 5300000000000000 0e 1100000000000000 0d "
      "e901000000000000 1e00000000000000" +
      // The footer: summary at 285, offsets at 519, checksum from 285 up to itself.
      "02 1400000000000000 1d01000000000000 0702000000000000 771ae56e" + magic;
  const std::string written = write_file(
      [](McapWriter& out) {
        out.add_metadata("m", {{"k", "v"}});
        const auto number = out.add_channel(out.add_schema("n", "e", "d"), "/t", "cdr", {});
        out.add_message(number, 258, "ab");
        out.add_message(number, 7, "c");
      },
      1 << 20);
  EXPECT_EQ(in_hexadecimal(written), without_spaces(file));
}

TEST(McapWriter, AFileWithoutMessagesHasNoChunk) {
  const std::string written = write_file([](McapWriter&) {}, 1 << 20);
  // Magic, header 19, end of data 13, statistics 9 + 46, their place 26, footer 29, magic.
  EXPECT_EQ(written.size(), 8u + 19 + 13 + 55 + 26 + 29 + 8);
}

// Each message ends a chunk of one byte: so each has a chunk and an index of its own.
TEST(McapWriter, AChunkEndsWhenItIsLongEnough) {
  const auto fill = [](McapWriter& out) {
    const auto number = out.add_channel(out.add_schema("n", "e", "d"), "/t", "cdr", {});
    for (int i = 0; i < 3; ++i) out.add_message(number, i, "x");
    EXPECT_EQ(out.messages(), 3u);
  };
  const std::size_t whole = write_file(fill, 1 << 20).size();
  // Per further chunk: chunk 9 + 40, index 9 + 6 (its entry is there anyway), its place 9 + 74.
  EXPECT_EQ(write_file(fill, 1).size(), whole + 2 * (49 + 15 + 83));
}

}  // namespace
}  // namespace results::report::test
