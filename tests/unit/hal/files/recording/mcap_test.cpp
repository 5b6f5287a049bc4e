#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "tests/unit/hal/files/recording/bags.h"

namespace hal::files::recording {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;
using Qos = TopicQos;

constexpr const char* kSmall = "small.mcap";
constexpr const char* kSound[] = {"zstd.mcap", "lz4.mcap", "chunks.mcap", "plain.mcap",
                                  "no_summary.mcap"};

TEST(Mcap, GivesTheSameForEveryCompressionWithAndWithoutAnIndex) {
  for (const char* name : kSound) {
    const Recording recording = read_recording(bag(name));
    ASSERT_EQ(recording.topics.size(), 3U) << name;
    EXPECT_EQ(recording.length, 920ms) << name;
    const RecordedTopic& scan = topic_of(recording, "rt/scan");
    EXPECT_EQ(scan.type, "sensor_msgs/msg/LaserScan");
    ASSERT_EQ(scan.samples.size(), 10U) << name;
    for (std::size_t i = 0; i < 10; ++i) {
      EXPECT_EQ(scan.samples[i].bytes, 400 + i) << name;
      EXPECT_EQ(scan.samples[i].at, 8ms + static_cast<int>(i) * 100ms) << name;  // as published
    }
    const RecordedTopic& fixed = topic_of(recording, "rt/tf_static");
    ASSERT_EQ(fixed.samples.size(), 1U);
    EXPECT_EQ(fixed.samples[0].bytes, 104U);
    EXPECT_EQ(fixed.samples[0].at, 0ms);  // as logged: it has no time of publication
    EXPECT_EQ(topic_of(recording, "rt/odom").samples[9].at, 920ms);
  }
}

TEST(Mcap, ReadsQosOfHumbleAndOfIron) {
  const Recording recording = read_recording(bag("zstd.mcap"));
  EXPECT_EQ(topic_of(recording, "rt/scan").qos,
            (Qos{Qos::Reliability::kBestEffort, Qos::Durability::kVolatile, 10, {}}));
  EXPECT_EQ(topic_of(recording, "rt/odom").qos,
            (Qos{Qos::Reliability::kReliable, Qos::Durability::kVolatile, 5, 50ms}));
  EXPECT_EQ(topic_of(recording, "rt/tf_static").qos,
            (Qos{Qos::Reliability::kReliable, Qos::Durability::kTransientLocal, {}, {}}));
  EXPECT_THAT(recording.notes,
              ElementsAre("1 topic: the depth of the history is not recorded, for DDS does not "
                          "announce it; 10 is ROS 2's default"));
}

TEST(Mcap, SaysOfOtherEncodingsWhatTheirSizesAre) {
  const Recording recording = read_recording(bag("json.mcap"));
  EXPECT_EQ(topic_of(recording, "/scan").samples.size(), 10U);  // no name of ROS 2
  EXPECT_THAT(recording.notes.front(), StartsWith("3 channels are encoded as 'json', not as CDR"));
}

TEST(Mcap, NamesACompressionThatItDoesNotKnow) {
  EXPECT_THAT(refusal(bag("brotli.mcap")),
              HasSubstr("brotli.mcap: byte 39: Chunk of 1851 bytes: its compression is 'brotli'; "
                        "zstd, lz4 and none are known"));
}

/// no_summary.mcap without the CRC of its data section, so that records can be put in.
std::string without_crc() {
  std::string file = content_of(bag("no_summary.mcap"));
  constexpr std::size_t kFooterAndMagic = 9 + 20 + 8, kCrc = 4;
  return file.replace(file.size() - kFooterAndMagic - kCrc, kCrc, kCrc, '\0');
}
constexpr std::size_t kAfterHeader = 39;

TEST(Mcap, SkipsRecordsThatItDoesNotKnow) {
  const Scratch scratch;
  const std::string unknown("\x80\x03\0\0\0\0\0\0\0abc", 12), later("\x10\0\0\0\0\0\0\0\0", 9);
  const std::string file = without_crc().insert(kAfterHeader, unknown + later);
  EXPECT_EQ(read_recording(scratch.write("more.mcap", file)).topics.size(), 3U);
}

TEST(Mcap, RefusesRecordsThatContradictEachOther) {
  const Scratch scratch;
  const auto said = [&scratch](const std::string& record) {
    return refusal(scratch.write("bad.mcap", without_crc().insert(kAfterHeader, record)));
  };
  EXPECT_THAT(said(std::string("\x05\x16\0\0\0\0\0\0\0", 9) + std::string(22, '\0')),
              HasSubstr("bad.mcap: byte 39: Message of 22 bytes: its channel is not defined"));
  EXPECT_THAT(said(std::string("\x05\x01\0\0\0\0\0\0\0a", 10)),
              HasSubstr("byte 39: Message of 1 bytes: it is too short for its fields"));
  EXPECT_THAT(said(std::string("\x04\x12\0\0\0\0\0\0\0\x09\0\x07\0\x02\0\0\0/a", 19) +
                   std::string(8, '\0')),
              HasSubstr("byte 39: Channel of 18 bytes: /a is of schema 7, which is not defined"));
  EXPECT_THAT(said(std::string("\x02\x14\0\0\0\0\0\0\0", 9) + std::string(20, '\0')),
              HasSubstr("byte 39: the Footer comes before a DataEnd"));
}

TEST(Mcap, RefusesAFileThatIsCutOffAnywhere) {
  const Scratch scratch;
  for (const char* name : {kSmall, "plain.mcap"}) {
    const std::string whole = content_of(bag(name));
    const std::filesystem::path cut = scratch.write("cut.mcap", whole);
    const std::size_t step = name == kSmall ? 1 : 31;
    for (std::size_t size = whole.size() - 1; size < whole.size(); size -= step) {
      std::filesystem::resize_file(cut, size);
      ASSERT_THAT(refusal(cut), HasSubstr("cut.mcap: byte ")) << name << ", " << size << " bytes";
    }
  }
}

TEST(Mcap, SaysHowManyMessagesAreWholeWhereItIsCutOff) {
  const Scratch scratch;
  const std::string whole = content_of(bag("plain.mcap"));
  const std::string half = whole.substr(0, whole.size() / 2);
  EXPECT_THAT(
      refusal(scratch.write("half.mcap", half)),
      testing::ContainsRegex("half.mcap: byte [0-9]+: the file ends within a record \\(Message\\): "
                             "[0-9]+ of its [0-9]+ bytes are there; 1[0-9] messages before "
                             "it are whole: `mcap recover` writes"));
}

TEST(Mcap, NoticesEachChangedByte) {
  const Scratch scratch;
  for (const char* name : {kSmall, "lz4.mcap"}) {
    const std::string whole = content_of(bag(name));
    const std::filesystem::path file = scratch.write("changed.mcap", whole);
    std::fstream changed(file, std::ios::in | std::ios::out | std::ios::binary);
    const auto put = [&changed](std::size_t at, int byte) {
      changed.seekp(static_cast<std::streamoff>(at)).put(static_cast<char>(byte)).flush();
    };
    for (std::size_t at = 0; at < whole.size(); at += name == kSmall ? 1 : 31) {
      put(at, whole[at] ^ (at % 2 == 0 ? 0x01 : 0xff));
      ASSERT_THAT(refusal(file), HasSubstr("changed.mcap: byte ")) << name << ", byte " << at;
      put(at, whole[at]);
    }
    EXPECT_EQ(refusal(file), "");
  }
}

TEST(Mcap, SurvivesChangedBytesThatNoCrcShows) {
  const Scratch scratch;
  std::mt19937 random(1);
  int refused = 0;
  for (int round = 0; round < 300; ++round) {
    std::string file = without_crc();
    for (int i = 0; i < 1 + round % 4; ++i) file[random() % 2000] = static_cast<char>(random());
    const std::string said = refusal(scratch.write("changed.mcap", file));
    if (said.empty()) continue;
    ++refused;
    ASSERT_THAT(said, HasSubstr("changed.mcap: byte ")) << round;
  }
  EXPECT_GT(refused, 30);
  EXPECT_LT(refused, 270);
}

TEST(Mcap, DoesNotBelieveLengthsThatAreTooLarge) {
  const Scratch scratch;
  std::string chunk = content_of(bag("zstd.mcap"));
  constexpr std::size_t kSizeOfChunk = 39 + 9 + 16;  // the announced size of its records
  for (const int size : {0x3f, 0x7f}) {              // 1 GiB, and more
    chunk[kSizeOfChunk + 3] = static_cast<char>(size);
    EXPECT_NE(refusal(scratch.write("large.mcap", chunk)), "");
  }
  EXPECT_THAT(refusal(scratch.write("large.mcap", chunk)), HasSubstr("the limit is 1073741824"));
}

TEST(Mcap, SaysWhatAFileIsThatIsNone) {
  const Scratch scratch;
  EXPECT_THAT(refusal(scratch.write("a.mcap", "hello, world")),
              HasSubstr("a.mcap: byte 0: it is not an MCAP file: it begins with 68 65 6c 6c 6f"));
  EXPECT_THAT(refusal(scratch.write("empty", "")), HasSubstr("it is empty"));
  EXPECT_THAT(refusal(scratch.write("old.bag", "#ROSBAG V2.0\n")),
              HasSubstr("old.bag: byte 0: it is a bag of ROS 1, which is not read: convert it"));
  EXPECT_THAT(refusal(scratch.write("b.pcap.gz", "\x1f\x8b\x08 rest")), HasSubstr("gunzip it"));
  EXPECT_THAT(refusal("/no/such/file"), HasSubstr("/no/such/file: cannot be read: No such file"));
  EXPECT_THAT(refusal("/dev/null"), HasSubstr("it is not a regular file"));
}

}  // namespace
}  // namespace hal::files::recording
