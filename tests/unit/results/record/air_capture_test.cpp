#include "results/record/air_capture.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "results/record/radiotap.h"
#include "sim/radio/mac/codec.h"
#include "tests/unit/results/record/test_run.h"

namespace results::record::test {
namespace {

using namespace std::chrono_literals;
using hal::AgentId;
using hal::Bytes;
using hal::Time;
using hal::Verdict;

/// At 11 Mb/s, of 100 us.
sim::radio::Frame ack(std::uint64_t id, AgentId from) {
  sim::radio::Frame frame;
  frame.id = id;
  frame.type = sim::radio::FrameType::kAck;
  frame.transmitter = from;
  frame.receiver = AgentId{0x0102};
  frame.rate = hal::BitsPerSecond{11e6};
  frame.airtime = 100us;
  return frame;
}

std::string content(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::uint32_t word(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes.at(at + i))) << (8 * i);
  }
  return value;
}

/// Times of the packets of a file [ns].
std::vector<std::uint64_t> times_in(const std::string& bytes) {
  std::vector<std::uint64_t> times;
  for (std::size_t at = 0; at < bytes.size(); at += word(bytes, at + 4)) {
    EXPECT_EQ(word(bytes, at + word(bytes, at + 4) - 4), word(bytes, at + 4)) << "block at " << at;
    if (word(bytes, at) != 6) continue;
    times.push_back((std::uint64_t{word(bytes, at + 12)} << 32U) | word(bytes, at + 16));
  }
  return times;
}

class AirCaptureTest : public testing::Test {
 protected:
  AirCaptureTest() : folder(testing::UnitTest::GetInstance()->current_test_info()->name()) {}

  AirCapture& open(std::optional<AgentId> heard_by = std::nullopt) {
    capture = std::make_unique<AirCapture>(
        folder.path() / "air.pcapng",
        AirCapture::Air{sim::radio::RadioConfig{sim::radio::Ieee80211bConfig{}}, {}}, heard_by,
        "air");
    return *capture;
  }
  std::vector<std::uint64_t> times(Time ended_at) {
    capture->finish(ended_at);
    return times_in(content(folder.path() / "air.pcapng"));
  }

  Folder folder;
  std::unique_ptr<AirCapture> capture;
};

TEST_F(AirCaptureTest, TheEarHasEachFrameAtItsEndInOrder) {
  AirCapture& ear = open();
  sim::radio::Frame lengthy = ack(1, AgentId{1});
  lengthy.airtime = 300us;
  ear.on_frame_start(Time{10us}, lengthy);
  ear.on_frame_start(Time{20us}, ack(2, AgentId{2}));
  ear.on_reception(Time{120us}, ack(2, AgentId{2}), AgentId{3}, Verdict::kDelivered, -60);
  ear.on_frame_start(Time{5s}, ack(3, AgentId{2}));
  EXPECT_EQ(times(Time{6s}), (std::vector<std::uint64_t>{120'000, 310'000, 5'000'100'000}));
}

TEST_F(AirCaptureTest, WhatIsBrokenOffOrInTheAirAtTheEndIsNotThere) {
  AirCapture& ear = open();
  ear.on_frame_start(Time{}, ack(1, AgentId{1}));
  ear.on_frame_start(Time{10us}, ack(2, AgentId{2}));
  ear.on_frame_cut(Time{50us}, ack(1, AgentId{1}));
  ear.on_frame_start(Time{200us}, ack(3, AgentId{1}));
  EXPECT_EQ(times(Time{299us}), std::vector<std::uint64_t>{110'000});
}

TEST_F(AirCaptureTest, AStationHasWhatItSendsAndReceivesAndNothingThatItLost) {
  AirCapture& station = open(AgentId{3});
  station.on_frame_start(Time{}, ack(1, AgentId{1}));
  station.on_reception(Time{100us}, ack(1, AgentId{1}), AgentId{3}, Verdict::kDelivered, -60);
  station.on_reception(Time{100us}, ack(1, AgentId{1}), AgentId{4}, Verdict::kDelivered, -60);
  station.on_reception(Time{200us}, ack(2, AgentId{1}), AgentId{3}, Verdict::kCollision, -60);
  station.on_frame_start(Time{300us}, ack(3, AgentId{3}));
  EXPECT_EQ(times(Time{1s}), (std::vector<std::uint64_t>{100'000, 400'000}));
}

/// Two MPDUs of 100 and 200 us in the air.
std::vector<sim::radio::Frame> an_ampdu() {
  std::vector<sim::radio::Frame> mpdus{ack(1, AgentId{1}), ack(2, AgentId{1})};
  for (sim::radio::Frame& mpdu : mpdus) {
    mpdu.ampdu = 7;
    mpdu.airtime_of_all = 300us;
  }
  mpdus[1].airtime = 200us;
  mpdus[1].airtime_before = 100us;
  mpdus[1].is_last_of_ampdu = true;
  return mpdus;
}

TEST_F(AirCaptureTest, TheMpdusOfAnAmpduHaveTheTimeOfItsEnd) {
  AirCapture& ear = open();
  for (const sim::radio::Frame& mpdu : an_ampdu()) ear.on_frame_start(Time{10us}, mpdu);
  EXPECT_EQ(times(Time{1s}), (std::vector<std::uint64_t>{310'000, 310'000}));
}

TEST_F(AirCaptureTest, AnAmpduThatIsBrokenOffIsNotThere) {
  AirCapture& ear = open();
  for (const sim::radio::Frame& mpdu : an_ampdu()) ear.on_frame_start(Time{10us}, mpdu);
  for (const sim::radio::Frame& mpdu : an_ampdu()) ear.on_frame_cut(Time{200us}, mpdu);
  EXPECT_TRUE(times(Time{1s}).empty());
}

TEST_F(AirCaptureTest, AStationHasTheMpdusOfAnAmpduThatItReceived) {
  AirCapture& station = open(AgentId{3});
  const auto mpdus = an_ampdu();
  station.on_reception(Time{310us}, mpdus[0], AgentId{3}, Verdict::kNoise, -60);
  station.on_reception(Time{310us}, mpdus[1], AgentId{3}, Verdict::kDelivered, -60);
  EXPECT_EQ(times(Time{1s}), std::vector<std::uint64_t>{310'000});
}

TEST_F(AirCaptureTest, AFileThatCannotBeWrittenIsNamed) {
  try {
    AirCapture(folder.path() / "not_there" / "air.pcapng",
               AirCapture::Air{sim::radio::RadioConfig{sim::radio::Ieee80211bConfig{}}, {}},
               std::nullopt, "air");
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_EQ(e.what(), (folder.path() / "not_there/air.pcapng").string() +
                            ": cannot be written: No such file or directory");
  }
}

// radiotap.org: fields in the order of their bits, each at a multiple of its size.
TEST(Radiotap, HasItsFieldsWhereTheyBelong) {
  const sim::radio::Frame frame = ack(1, AgentId{1});
  Bytes expected{0,
                 0,
                 24,
                 0,  // version, padding, length
                 0x6f,
                 0,
                 0,
                 0,  // TSFT, flags, rate, channel, signal, noise
                 0x15,
                 0xcd,
                 0x5b,
                 0x07,
                 0,
                 0,
                 0,
                 0,  // 123456789 us
                 0x10,
                 22,  // FCS at the end; 11 Mb/s
                 0x6c,
                 0x09,
                 0x80,
                 0x00,  // 2412 MHz, in 2.4 GHz
                 static_cast<std::uint8_t>(-61),
                 static_cast<std::uint8_t>(-95)};
  const Bytes mpdu = sim::radio::encode(frame);
  expected.insert(expected.end(), mpdu.begin(), mpdu.end());
  EXPECT_EQ(with_radiotap(frame, {.mpdu_start = Time{123456789999ns},
                                  .frequency = 2412,
                                  .signal_dbm = -60.6,
                                  .noise_dbm = -95.0}),
            expected);
}

TEST(Radiotap, LeavesOutWhatItCannotSay) {
  sim::radio::Frame frame = ack(1, AgentId{1});
  frame.rate = hal::BitsPerSecond{1.2e6};
  const Bytes packet = with_radiotap(frame, {.frequency = 2412});
  EXPECT_EQ(packet.at(2), 22);
  EXPECT_EQ(packet.at(4), 0x0b);
}

}  // namespace
}  // namespace results::record::test
