#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <string>

#include "hal/files/recording/rtps_traffic.h"
#include "tests/unit/hal/files/recording/captures.h"

namespace hal::files::recording {
namespace {

using namespace std::chrono_literals;
using testing::Contains;
using testing::HasSubstr;

constexpr const char* kCaptures[] = {"cyclone_v4.pcap", "cyclone_v6.pcap", "fastdds_v4.pcap",
                                     "fastdds_v6.pcap"};

Recording read(const std::string& content) {
  const Scratch folder;
  return read_recording(folder.write("some.cap", content));
}

std::string ip_of(const std::string& ethernet) { return ethernet.substr(14); }
std::string type_of(const std::string& ethernet) { return ethernet.substr(12, 2); }

/// A data frame to or from an access point, behind radiotap with TSFT and flags.
/// @param control  little-endian frame control.  @param sequence  number of the MSDU.
std::string wireless(const std::string& ethernet, std::uint16_t control, std::uint16_t sequence,
                     bool has_fcs = true) {
  const std::string access_point("\x02\0\0\0\0\x63", 6);
  const std::string source = ethernet.substr(6, 6), destination = ethernet.substr(0, 6);
  const bool to = (control & 0x0100) != 0, qos = (control & 0x80) != 0;
  std::string radiotap = number(0, 2, false) + number(17, 2, false) + number(3, 4, false) +
                         std::string(8, 't') + std::string(1, has_fcs ? '\x10' : '\0');
  std::string frame = number(control, 2, false) + number(0, 2, false) +
                      (to ? access_point : destination) + (to ? source : access_point) +
                      (to ? destination : source) +
                      number(static_cast<std::uint64_t>(sequence) << 4U, 2, false);
  if (qos) frame += number(5, 2, false);
  frame += std::string("\xaa\xaa\x03\0\0\0", 6) + type_of(ethernet) + ip_of(ethernet);
  return radiotap + frame + (has_fcs ? "FCS4" : "");
}

TEST(Capture, HoldsTheSamplesThatCycloneSentOncePerSample) {
  const Recording recording = read(real_capture("cyclone_v4.pcap"));
  const RecordedTopic& topic = topic_of(recording, "DDSPerfRDataKS");
  EXPECT_EQ(topic.type, "KeyedSeq");
  // ddsperf pub 1Hz size 17000: two readers, each sample in fragments of RTPS and of IP.
  ASSERT_EQ(topic.samples.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(topic.samples[i].bytes, 17004U);
    EXPECT_NEAR(to_seconds(topic.samples[i].at - topic.samples[0].at), static_cast<double>(i),
                3e-3);
  }
  ASSERT_TRUE(topic.qos);
  EXPECT_EQ(topic.qos->reliability, TopicQos::Reliability::kReliable);
  EXPECT_EQ(topic.qos->depth, std::nullopt);  // Cyclone announces it
  EXPECT_EQ(topic_of(recording, "DDSPerfUDataKS").qos->reliability,
            TopicQos::Reliability::kBestEffort);
}

TEST(Capture, TellsWhichParticipantsWriteAndReadATopic) {
  // sim/air/ledger's captures: a ddsperf that publishes, and two that subscribe.
  const Recording recording = read(real_capture("cyclone_v4.pcap"));
  const RecordedTopic& topic = topic_of(recording, "DDSPerfRDataKS");
  ASSERT_TRUE(topic.writer && topic.reader);
  EXPECT_NE(*topic.writer, *topic.reader);
  for (const RecordedTopic& one : recording.topics) EXPECT_LT(one.writer.value(), 3U) << one.name;
}

TEST(Capture, HoldsTheSamplesThatFastDdsSent) {
  const Recording recording = read(real_capture("fastdds_v6.pcap"));
  const RecordedTopic& topic = topic_of(recording, "camera");
  ASSERT_EQ(topic.samples.size(), 7U);
  EXPECT_EQ(topic.samples[6].bytes, 12032U);
  EXPECT_NEAR(to_seconds(recording.length), 3, 1e-2);  // 2 Hz
  EXPECT_EQ(topic.qos->durability, TopicQos::Durability::kTransientLocal);
  const Recording four = read(real_capture("fastdds_v4.pcap"));
  ASSERT_EQ(topic_of(four, "camera").samples.size(), 1U);
  EXPECT_EQ(topic_of(four, "camera").samples[0].bytes, 70032U);
}

TEST(Capture, IsTheSameInEveryFormOfAFile) {
  for (const char* name : kCaptures) {
    const auto frames = frames_of(real_capture(name));
    const std::string expected = summary_of(read(real_capture(name)));
    for (const bool is_big : {false, true}) {
      CaptureForm form{.is_big = is_big};
      EXPECT_EQ(summary_of(read(pcap_of(frames, form))), expected);
      form.has_nanoseconds = true;
      EXPECT_EQ(summary_of(read(pcap_of(frames, form))), expected);
      for (const int resolution : {6, 9, 0x80 + 24, 0x80 + 32})
        EXPECT_EQ(summary_of(read(pcapng_of(frames, form, static_cast<std::uint8_t>(resolution)))),
                  expected)
            << name << ", resolution " << resolution;
    }
  }
}

TEST(Capture, IsTheSameOnEveryLink) {
  const auto frames = frames_of(real_capture("cyclone_v4.pcap"));
  const std::string expected = summary_of(read(real_capture("cyclone_v4.pcap")));
  std::uint16_t sequence = 0;
  const CaptureForm forms[] = {
      {.wrapped =
           [](const std::string& e) {
             return e.substr(0, 12) + std::string("\x81\0\0\x05", 4) + e.substr(12);
           }},
      {.link_type = 101, .wrapped = ip_of},
      {.link_type = 0,
       .wrapped = [](const std::string& e) { return std::string("\2\0\0\0", 4) + ip_of(e); }},
      {.link_type = 113,
       .wrapped =
           [](const std::string& e) { return std::string(14, 's') + type_of(e) + ip_of(e); }},
      {.link_type = 276,
       .wrapped =
           [](const std::string& e) { return type_of(e) + std::string(18, 's') + ip_of(e); }},
      {.link_type = 127,
       .wrapped = [&](const std::string& e) { return wireless(e, 0x0108, sequence++); }},
      {.link_type = 127,
       .wrapped = [&](const std::string& e) { return wireless(e, 0x0188, sequence++, false); }},
      {.link_type = 105,
       .wrapped =
           [&](const std::string& e) { return wireless(e, 0x0088, sequence++, false).substr(17); }},
  };
  for (const CaptureForm& form : forms) {
    sequence = 0;
    EXPECT_EQ(summary_of(read(pcap_of(frames, form))), expected) << form.link_type;
  }
}

TEST(Capture, CountsAFrameOnceHoweverOftenItIsOnTheAir) {
  const auto frames = frames_of(real_capture("cyclone_v4.pcap"));
  std::uint16_t sequence = 0;
  const CaptureForm once{.link_type = 127, .wrapped = [&](const std::string& e) {
                           return wireless(e, 0x0188, sequence++);
                         }};
  const std::string expected = summary_of(read(pcap_of(frames, once)));
  EXPECT_THAT(expected, HasSubstr("port 7401"));
  // To the access point, again with Retry set, then from the access point.
  std::vector<EthernetFrame> thrice;
  for (const EthernetFrame& one : frames) thrice.insert(thrice.end(), 3, one);
  sequence = 0;
  const CaptureForm often{.link_type = 127, .wrapped = [&](const std::string& e) {
                            const std::uint16_t number = sequence++;
                            const auto own = static_cast<std::uint16_t>(number / 3);
                            if (number % 3 == 2) return wireless(e, 0x0288, own);
                            return wireless(e, number % 3 == 1 ? 0x0988 : 0x0188, own);
                          }};
  EXPECT_EQ(summary_of(read(pcap_of(thrice, often))), expected);
}

TEST(Capture, ReadsTheSubframesOfAnAmsdu) {
  const auto frames = frames_of(real_capture("cyclone_v4.pcap"));
  const auto flow = [](const Recording& recording) {
    return recording.flows.empty() ? 0 : recording.flows.front().datagrams.size();
  };
  // One frame with two subframes: the capture's frames in pairs.
  std::vector<EthernetFrame> firsts;
  std::vector<std::string> bodies;
  for (std::size_t i = 0; i + 1 < frames.size(); i += 2) {
    std::string body;
    for (const EthernetFrame& one : {frames[i], frames[i + 1]}) {
      const std::string msdu =
          std::string("\xaa\xaa\x03\0\0\0", 6) + type_of(one.octets) + ip_of(one.octets);
      body += one.octets.substr(0, 12) + number(msdu.size(), 2, true) + msdu;
      body.resize((body.size() + 3) / 4 * 4);
    }
    firsts.push_back(frames[i]);
    bodies.push_back(body);
  }
  std::size_t next = 0;
  const CaptureForm form{.link_type = 105, .wrapped = [&](const std::string& e) {
                           std::string frame =
                               wireless(e, 0x0188, static_cast<std::uint16_t>(next), false);
                           frame = frame.substr(17, 26);
                           frame[24] = static_cast<char>(0x80);
                           return frame + bodies[next++];
                         }};
  const Recording whole = read(real_capture("cyclone_v4.pcap"));
  const Recording paired = read(pcap_of(firsts, form));
  EXPECT_EQ(topic_of(paired, "DDSPerfRDataKS").samples.size(), 4U);
  EXPECT_EQ(flow(paired), flow(whole));
}

TEST(Capture, PutsFragmentsTogetherInAnyOrder) {
  auto frames = frames_of(real_capture("cyclone_v4.pcap"));
  const Recording ordered = read(pcap_of(frames, {}));
  std::ranges::reverse(frames);
  const Recording reversed = read(pcap_of(frames, {}));
  EXPECT_EQ(topic_of(reversed, "DDSPerfRDataKS").samples.size(),
            topic_of(ordered, "DDSPerfRDataKS").samples.size());
  EXPECT_EQ(reversed.flows.front().datagrams.size(), ordered.flows.front().datagrams.size());
}

TEST(Capture, SaysAtWhichAddressATopicIsWritten) {
  // The same programs once more, at another address and with other GUIDs: from each participant's
  // prefix only the first octet is another one.
  const auto frames = frames_of(real_capture("fastdds_v6.pcap"));
  constexpr std::size_t kLastOfSource = 14 + 23;
  std::vector<EthernetFrame> both = frames;
  for (EthernetFrame other : frames) {
    other.octets[kLastOfSource] = '\x99';
    const std::size_t rtps = other.octets.find("RTPS");
    const std::string prefix = rtps == std::string::npos ? "" : other.octets.substr(rtps + 8, 12);
    for (std::size_t at = prefix.empty() ? prefix.npos : other.octets.find(prefix);
         at != std::string::npos; at = other.octets.find(prefix, at))
      other.octets[at] = '\x09';
    both.push_back(other);
  }
  const std::size_t before = topic_of(read(pcap_of(frames, {})), "camera").samples.size();
  const Recording recording = read(pcap_of(both, {}));
  EXPECT_GT(topic_of(recording, "camera").samples.size(), before);
  EXPECT_THAT(recording.notes, Contains(testing::ContainsRegex("^written at fe80:.*99: .*camera")));
  for (const std::string& note : read(pcap_of(frames, {})).notes)
    EXPECT_THAT(note, testing::Not(HasSubstr("written at"))) << "from one address only";
}

TEST(Capture, NamesWritersThatItDoesNotKnow) {
  // The capture begins after discovery.
  auto frames = frames_of(real_capture("cyclone_v4.pcap"));
  const std::size_t half = frames.size() / 2;
  frames.erase(frames.begin(), frames.begin() + static_cast<std::ptrdiff_t>(half));
  const Recording recording = read(pcap_of(frames, {}));
  ASSERT_EQ(recording.topics.size(), 1U);
  EXPECT_THAT(recording.topics[0].name, testing::ContainsRegex("^unknown_writer_[0-9a-f]{24}_"));
  EXPECT_FALSE(recording.topics[0].qos);
  EXPECT_EQ(recording.topics[0].samples.front().bytes, 17004U);
  EXPECT_THAT(recording.notes, Contains(HasSubstr("1 writer is not announced in the capture")));
}

TEST(Capture, SaysWhatItsSnapLengthCutOff) {
  auto frames = frames_of(real_capture("fastdds_v6.pcap"));
  std::string file = pcap_of({}, {});
  for (const EthernetFrame& one : frames) {
    const std::string kept = one.octets.substr(0, 96);
    file += number(one.seconds, 4, false) + number(one.microseconds, 4, false) +
            number(kept.size(), 4, false) + number(one.octets.size(), 4, false) + kept;
  }
  EXPECT_THAT(read(file).notes,
              Contains(testing::ContainsRegex("[0-9]+ packets were cut by the snap")));
}

TEST(Capture, CountsWhatItCannotSee) {
  const auto frames = frames_of(real_capture("cyclone_v4.pcap"));
  std::uint16_t control = 0x4108, sequence = 0;
  const CaptureForm form{.link_type = 127, .wrapped = [&](const std::string& e) {
                           return wireless(e, control, sequence++);
                         }};
  const std::string count = std::to_string(frames.size());
  EXPECT_THAT(read(pcap_of(frames, form)).notes,
              testing::ElementsAre(count + " frames are encrypted; what they carry is not seen"));
  control = 0x0508;
  EXPECT_THAT(read(pcap_of(frames, form)).notes,
              testing::ElementsAre(count + " frames are fragments of MSDUs and are left out"));
}

TEST(Capture, CountsDatagramsThatLackFragments) {
  auto frames = frames_of(real_capture("cyclone_v4.pcap"));
  // The last fragments: an offset, and none follow (RFC 791, 3.1).
  const auto is_last = [](const EthernetFrame& one) {
    const auto octet = [&one](std::size_t at) {
      return static_cast<unsigned char>(one.octets[at]);
    };
    const int flags = octet(20) << 8 | octet(21);
    return octet(12) == 8 && octet(13) == 0 && (flags & 0x2000) == 0 && (flags & 0x1fff) != 0;
  };
  const std::size_t before = frames.size();
  std::erase_if(frames, is_last);
  const std::size_t erased = before - frames.size();
  ASSERT_GT(erased, 0U);
  EXPECT_THAT(read(pcap_of(frames, {})).notes,
              Contains(std::to_string(erased) + " IP datagrams lack fragments and are left out"));
}

TEST(Capture, CountsPacketsWithoutATime) {
  const auto frames = frames_of(real_capture("fastdds_v6.pcap"));
  std::string file = pcapng_of(frames, {}, 9);
  file += number(3, 4, false) + number(20, 4, false) + number(4, 4, false) + "abcd" +
          number(20, 4, false);
  EXPECT_THAT(read(file).notes, Contains("1 packets have no time stamp and are left out"));
}

TEST(Capture, GivesTypesTheirNamesInRos2) {
  EXPECT_EQ(ros_type("sensor_msgs::msg::dds_::LaserScan_"), "sensor_msgs/msg/LaserScan");
  EXPECT_EQ(ros_type("nav2_msgs::action::dds_::NavigateToPose_SendGoal_Request_"),
            "nav2_msgs/action/NavigateToPose_SendGoal_Request");
  EXPECT_EQ(ros_type("KeyedSeq"), "KeyedSeq");
  EXPECT_EQ(ros_type("a::dds_::B"), "a::dds_::B");
}

TEST(Capture, RefusesAFileThatIsCutOffWithinAPacket) {
  const Scratch folder;
  auto frames = frames_of(real_capture("fastdds_v6.pcap"));
  frames.resize(6);
  for (const bool is_ng : {false, true}) {
    const std::string whole = is_ng ? pcapng_of(frames, {}, 9) : pcap_of(frames, {});
    std::vector<std::size_t> ends;  // of packets: there the file is one of fewer packets
    for (std::size_t count = 0; count <= frames.size(); ++count) {
      const std::vector fewer(frames.begin(), frames.begin() + static_cast<std::ptrdiff_t>(count));
      ends.push_back((is_ng ? pcapng_of(fewer, {}, 9) : pcap_of(fewer, {})).size());
    }
    if (is_ng) ends.push_back(28);  // the end of the section's header
    const std::filesystem::path cut = folder.write("cut.cap", whole);
    for (std::size_t size = whole.size() - 1; size + 1 > 0; --size) {
      std::filesystem::resize_file(cut, size);
      const std::string said = refusal(cut);
      if (std::ranges::count(ends, size) > 0) {
        EXPECT_EQ(said, "") << size;
      } else {
        ASSERT_THAT(said, HasSubstr("cut.cap: byte ")) << size;
      }
    }
  }
  EXPECT_THAT(refusal(folder.write("cut.cap", pcap_of(frames, {}) + std::string(20, '\x01'))),
              HasSubstr("the file ends within packet 7: 4 of its 16843009 bytes are there"));
}

TEST(Capture, SurvivesChangedBytes) {
  const Scratch folder;
  std::mt19937 random(1);
  std::size_t refused = 0;
  for (int round = 0; round < 200; ++round) {
    const char* const name = kCaptures[random() % 4];
    std::string file = real_capture(name);
    if (round % 3 == 1) file = pcapng_of(frames_of(file), {}, 6);
    const std::size_t from = round % 2 == 0 ? 0 : random() % file.size();
    for (int i = 0; i < 40; ++i) {
      const std::size_t at = from + random() % std::min<std::size_t>(file.size() - from, 4000);
      file[at] = static_cast<char>(random());
    }
    const std::string said = refusal(folder.write("changed.cap", file));
    if (said.empty()) continue;
    ++refused;
    ASSERT_THAT(said, HasSubstr("changed.cap: byte ")) << round;
  }
  EXPECT_GT(refused, 20U);
}

TEST(Capture, NamesALinkTypeThatItDoesNotRead) {
  const auto frames = frames_of(real_capture("fastdds_v6.pcap"));
  const Scratch folder;
  EXPECT_THAT(refusal(folder.write("can.pcap", pcap_of(frames, {.link_type = 227}))),
              HasSubstr("can.pcap: byte 40: packet 1: packets of link type 227 are not read"));
}

}  // namespace
}  // namespace hal::files::recording
