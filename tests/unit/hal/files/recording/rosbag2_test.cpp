#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zstd.h>

#include <string>

#include "tests/unit/hal/files/recording/bags.h"

namespace hal::files::recording {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;

std::string zstd(const std::string& data) {
  std::string result(ZSTD_compressBound(data.size()), '\0');
  result.resize(ZSTD_compress(result.data(), result.size(), data.data(), data.size(), 3));
  return result;
}

/// A CDR message of that size.
std::string cdr(std::size_t size) {
  return std::string("\0\1\0\0", 4) + std::string(size - 4, 'x');
}

std::vector<StoredMessage> some_messages() {
  return {
      {2, 5'000'000'000, cdr(60)}, {1, 5'100'000'000, cdr(1000)}, {1, 5'200'000'000, cdr(1004)}};
}

/// metadata.yaml as rosbag2 writes it.
std::string metadata(const std::string& files, const std::string& storage = "sqlite3",
                     const std::string& compression = "", int messages = 3) {
  return fmt::format(
      "rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: {}\n  duration:\n"
      "    nanoseconds: 200000000\n  starting_time:\n    nanoseconds_since_epoch: 5000000000\n"
      "  message_count: {}\n  topics_with_message_count:\n    []\n  compression_format: \"{}\"\n"
      "  compression_mode: \"\"\n  relative_file_paths:\n{}",
      storage, messages, compression, files);
}

void expect_some_messages(const Recording& recording) {
  const RecordedTopic& scan = topic_of(recording, "rt/scan");
  EXPECT_EQ(scan.type, "sensor_msgs/msg/LaserScan");
  ASSERT_EQ(scan.samples.size(), 2U);
  EXPECT_EQ(scan.samples[0].bytes, 1000U);
  EXPECT_EQ(scan.samples[0].at, 100ms);
  EXPECT_EQ(scan.samples[1].bytes, 1004U);
  EXPECT_EQ(scan.samples[1].at, 200ms);
  ASSERT_TRUE(scan.qos);
  EXPECT_EQ(scan.qos->reliability, TopicQos::Reliability::kBestEffort);
  EXPECT_EQ(scan.qos->depth, 5U);
  EXPECT_FALSE(topic_of(recording, "rt/tf_static").qos);
  EXPECT_EQ(recording.length, 200ms);
}

TEST(Rosbag2, IsReadFromItsFolderItsMetadataOrItsFile) {
  const Scratch scratch;
  scratch.write("bag/metadata.yaml", metadata("    - bag_0.db3\n"));
  write_db3(scratch.path() / "bag/bag_0.db3", some_messages());
  for (const char* name : {"bag", "bag/metadata.yaml", "bag/bag_0.db3"}) {
    const Recording recording = read_recording(scratch.path() / name);
    expect_some_messages(recording);
    EXPECT_THAT(recording.notes, ElementsAre()) << name;
  }
}

TEST(Rosbag2, NeedsNoMetadata) {
  const Scratch scratch;
  write_db3(scratch.path() / "bag_0.db3", some_messages());
  const Recording file = read_recording(scratch.path() / "bag_0.db3");
  expect_some_messages(file);
  EXPECT_THAT(file.notes, ElementsAre(HasSubstr("there is no metadata.yaml beside the file")));
  const Recording folder = read_recording(scratch.path());
  expect_some_messages(folder);
  EXPECT_THAT(folder.notes, ElementsAre(HasSubstr("the 1 file of the folder were read")));
}

TEST(Rosbag2, JoinsTheFilesOfASplitBag) {
  const Scratch scratch;
  const auto all = some_messages();
  for (std::size_t i = 0; i < all.size(); ++i)
    write_db3(scratch.path() / fmt::format("bag_{}.db3", i * 5), {all[i]});  // 0, 5, 10
  expect_some_messages(read_recording(scratch.path()));
  scratch.write("metadata.yaml", metadata("    - bag_0.db3\n    - bag_5.db3\n    - bag_10.db3\n"));
  const Recording recording = read_recording(scratch.path());
  expect_some_messages(recording);
  EXPECT_TRUE(recording.notes.empty());
}

TEST(Rosbag2, SaysWhichFileIsMissing) {
  const Scratch scratch;
  scratch.write("metadata.yaml", metadata("    - bag_0.db3\n    - bag_1.db3\n"));
  write_db3(scratch.path() / "bag_0.db3", some_messages());
  EXPECT_THAT(refusal(scratch.path()),
              HasSubstr("metadata.yaml:15:7: the file bag_1.db3 is missing"));
}

TEST(Rosbag2, FindsTheFilesOfEarlyVersions) {
  const Scratch scratch;  // whose metadata name them from the folder above
  scratch.write("bag/metadata.yaml", metadata("    - bag/bag_0.db3\n"));
  write_db3(scratch.path() / "bag/bag_0.db3", some_messages());
  expect_some_messages(read_recording(scratch.path() / "bag"));
}

TEST(Rosbag2, ReadsCompressedFiles) {
  const Scratch scratch, plain;
  write_db3(plain.path() / "bag_0.db3", some_messages());
  scratch.write("bag_0.db3.zstd", zstd(content_of(plain.path() / "bag_0.db3")));
  expect_some_messages(read_recording(scratch.path() / "bag_0.db3.zstd"));
  scratch.write("metadata.yaml", metadata("    - bag_0.db3.zstd\n", "sqlite3", "zstd"));
  expect_some_messages(read_recording(scratch.path()));
}

TEST(Rosbag2, TakesTheSizeThatCompressedMessagesHad) {
  const Scratch scratch;
  auto messages = some_messages();
  for (StoredMessage& one : messages) one.data = zstd(one.data);
  EXPECT_LT(messages[1].data.size(), 100U);
  write_db3(scratch.path() / "bag_0.db3", messages);
  scratch.write("metadata.yaml", metadata("    - bag_0.db3\n", "sqlite3", "zstd"));
  expect_some_messages(read_recording(scratch.path()));
}

TEST(Rosbag2, ReadsMcapInsideABag) {
  const Scratch scratch;
  scratch.write("bag_0.mcap", content_of(bag("zstd.mcap")));
  scratch.write("metadata.yaml", metadata("    - bag_0.mcap\n", "mcap", "", 21));
  const Recording recording = read_recording(scratch.path());
  EXPECT_EQ(topic_of(recording, "rt/scan").samples.size(), 10U);
  EXPECT_EQ(recording.notes.size(), 1U);  // of the depth
}

TEST(Rosbag2, SaysWhereTheNumberOfMessagesIsAnotherOne) {
  const Scratch scratch;
  scratch.write("metadata.yaml", metadata("    - bag_0.db3\n", "sqlite3", "", 7));
  write_db3(scratch.path() / "bag_0.db3", some_messages());
  EXPECT_THAT(read_recording(scratch.path()).notes,
              ElementsAre("metadata.yaml tells of 7 messages; the files hold 3"));
}

TEST(Rosbag2, SaysWhereTimeStampsAreFarApart) {
  const Scratch scratch;
  write_db3(scratch.path() / "bag_0.db3", {{1, 7, cdr(8)}, {1, 1'700'000'000'000'000'000, cdr(8)}});
  EXPECT_THAT(read_recording(scratch.path()).notes,
              testing::Contains("from the first sample to the last are 19675 days: its time stamps "
                                "may be of different clocks"));
}

TEST(Rosbag2, RefusesMetadataThatItCannotFollow) {
  const Scratch scratch;
  const auto said = [&scratch](const std::string& text) {
    return refusal(scratch.write("metadata.yaml", text));
  };
  EXPECT_THAT(said(metadata("    - a.db3\n", "hdf5")),
              HasSubstr("metadata.yaml:3:23: the storage_identifier is 'hdf5'; sqlite3 and mcap "
                        "are known"));
  EXPECT_THAT(said(metadata("    - a.db3\n", "sqlite3", "lz4")),
              HasSubstr("the compression_format is 'lz4'; zstd and none are known"));
  EXPECT_THAT(said("mass: 3 kg\n"), HasSubstr("metadata.yaml:1:1: there is no "
                                              "rosbag2_bagfile_information"));
  EXPECT_THAT(said("a: [1, 2\n"), HasSubstr("metadata.yaml:"));
  EXPECT_THAT(said(""), HasSubstr("metadata.yaml:1:1: there is no rosbag2_bagfile_information"));
  EXPECT_THAT(said(metadata("    []\n")), HasSubstr("relative_file_paths names no file"));
}

TEST(Rosbag2, RefusesAFolderThatIsNone) {
  const Scratch scratch;
  EXPECT_THAT(refusal(scratch.path()), HasSubstr("it is not a rosbag2"));
}

TEST(SqliteBag, IsRefusedWhereItIsCutOffAnywhere) {
  const Scratch scratch;
  write_db3(scratch.path() / "bag.db3", some_messages());
  const std::string whole = content_of(scratch.path() / "bag.db3");
  const std::filesystem::path cut = scratch.write("cut.db3", whole);
  for (std::size_t size = whole.size() - 1; size + 1 > 0; --size) {
    std::filesystem::resize_file(cut, size);
    ASSERT_THAT(refusal(cut), HasSubstr("cut.db3: byte ")) << size;
  }
  EXPECT_THAT(refusal(scratch.write("cut.db3", whole.substr(0, whole.size() - 1))),
              HasSubstr("it is cut off"));
}

TEST(SqliteBag, SurvivesEachChangedByte) {
  const Scratch scratch;
  write_db3(scratch.path() / "bag.db3", some_messages());
  const std::string whole = content_of(scratch.path() / "bag.db3");
  const std::filesystem::path file = scratch.write("changed.db3", whole);
  std::fstream changed(file, std::ios::in | std::ios::out | std::ios::binary);
  const auto put = [&changed](std::size_t at, int byte) {
    changed.seekp(static_cast<std::streamoff>(at)).put(static_cast<char>(byte)).flush();
  };
  std::size_t refused = 0;
  for (std::size_t at = 0; at < whole.size(); ++at) {
    if (whole[at] == 0 && at % 16 != 0) continue;  // most is room between rows
    put(at, whole[at] ^ 0x55);
    const std::string said = refusal(file);
    put(at, whole[at]);
    if (said.empty()) continue;
    ASSERT_THAT(said, HasSubstr("changed.db3: ")) << at;
    ++refused;
  }
  EXPECT_GT(refused, 100U);
}

TEST(SqliteBag, NamesTheRowThatIsWrong) {
  const Scratch scratch;
  const std::filesystem::path file = scratch.path() / "bag.db3";
  const auto said = [&](const std::string& sql) {
    std::filesystem::remove(file);
    write_db3(file, some_messages());
    execute(file, sql);
    return refusal(file);
  };
  EXPECT_THAT(said("UPDATE messages SET topic_id = 9 WHERE id = 2"),
              HasSubstr("bag.db3: table messages, row 2: there is no topic with the id 9"));
  EXPECT_THAT(said("UPDATE messages SET timestamp = 'noon' WHERE id = 3"),
              HasSubstr("table messages, row 3: timestamp is not a whole number"));
  EXPECT_THAT(said("UPDATE messages SET timestamp = -1 WHERE id = 3"),
              HasSubstr("table messages, row 3: its timestamp is -1 ns"));
  EXPECT_THAT(said("UPDATE messages SET data = 'text' WHERE id = 1"),
              HasSubstr("table messages, row 1: data is not a blob"));
  EXPECT_THAT(said("UPDATE messages SET data = x'28b52ffd00' WHERE id = 1"),
              HasSubstr("table messages, row 1: of /tf_static: cannot be decompressed: zstd"));
  EXPECT_THAT(said("UPDATE topics SET offered_qos_profiles = 'loud' WHERE id = 1"),
              HasSubstr("table topics, row 1: topic /scan: offered_qos_profiles: it is 'loud'"));
  EXPECT_THAT(said("DROP TABLE messages"), HasSubstr("bag.db3: it has no table messages"));
}

TEST(SqliteBag, DoesNotRunWhatAViewComputes) {
  const Scratch scratch;
  const std::filesystem::path file = scratch.path() / "bag.db3";
  write_db3(file, {});
  execute(
      file,
      "DROP TABLE messages; CREATE VIEW messages AS WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL "
      "SELECT i + 1 FROM n) SELECT i AS id, 1 AS topic_id, i AS timestamp, x'00' AS data FROM n");
  EXPECT_THAT(refusal(file), HasSubstr("bag.db3: messages is not an ordinary table: CREATE VIEW"));
}

TEST(SqliteBag, ReadsTablesWithoutQos) {
  const Scratch scratch;  // before Foxy
  execute(scratch.path() / "bag.db3",
          "CREATE TABLE topics(id INTEGER PRIMARY KEY,name TEXT NOT NULL,type TEXT NOT NULL,"
          "serialization_format TEXT NOT NULL);"
          "CREATE TABLE messages(id INTEGER PRIMARY KEY,topic_id INTEGER NOT NULL,timestamp "
          "INTEGER NOT NULL, data BLOB NOT NULL);"
          "INSERT INTO topics VALUES(1, '/a', 'std_msgs/msg/String', 'cdr');"
          "INSERT INTO messages VALUES(1, 1, 7, x'00010000')");
  const Recording recording = read_recording(scratch.path() / "bag.db3");
  EXPECT_EQ(topic_of(recording, "rt/a").samples.size(), 1U);
  EXPECT_FALSE(topic_of(recording, "rt/a").qos);
}

}  // namespace
}  // namespace hal::files::recording
