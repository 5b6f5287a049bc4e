#include "sim/agents/frame_digest.h"

#include <gtest/gtest.h>

#include <bit>
#include <functional>
#include <memory>
#include <set>
#include <vector>

#include "sim/radio/mac/frame.h"

namespace {

using namespace std::chrono_literals;
using hal::AgentId;
using hal::Time;
using sim::agents::FrameDigest;
using sim::radio::Frame;

struct Sent {
  Time at{1500ms};
  Frame frame;
};

Sent a_frame() {
  Sent sent;
  sent.frame.transmitter = AgentId{1};
  sent.frame.receiver = AgentId{2};
  sent.frame.duration = 300us;
  sent.frame.sequence = 5;
  sent.frame.rate = hal::BitsPerSecond{11e6};
  sent.frame.air_length = 272;
  sent.frame.airtime = 250us;
  sent.frame.ds = sim::radio::Ds::kTo;
  sent.frame.address3 = AgentId{5};
  sent.frame.ethertype = 0x0800;
  sent.frame.payload = std::make_shared<const hal::Bytes>(hal::Bytes{1, 2, 3});
  return sent;
}

std::uint64_t digest_of(const std::vector<Sent>& frames) {
  FrameDigest digest;
  for (const Sent& one : frames) digest.on_frame_start(one.at, one.frame);
  return digest.value();
}

TEST(FrameDigest, EqualFramesHaveEqualDigests) {
  EXPECT_EQ(digest_of({a_frame()}), digest_of({a_frame()}));
  EXPECT_NE(digest_of({}), digest_of({a_frame()}));
  EXPECT_NE(digest_of({a_frame()}), digest_of({a_frame(), a_frame()}));
}

TEST(FrameDigest, EachFieldAndEachByteOfThePayloadCounts) {
  const std::vector<std::function<void(Sent&)>> mutations = {
      [](Sent& s) { s.at += 1ns; },
      [](Sent& s) { s.frame.transmitter.value ^= 1; },
      [](Sent& s) { s.frame.receiver.value ^= 1; },
      [](Sent& s) { s.frame.type = sim::radio::FrameType::kRts; },
      [](Sent& s) { s.frame.ds = sim::radio::Ds::kFrom; },
      [](Sent& s) { s.frame.address3.value ^= 1; },
      [](Sent& s) { s.frame.group = 0x01005e000001; },
      [](Sent& s) { s.frame.sequence ^= 1; },
      [](Sent& s) { s.frame.retry = true; },
      [](Sent& s) { s.frame.rate.value = 2e6; },
      [](Sent& s) { s.frame.air_length ^= 1; },
      [](Sent& s) { s.frame.airtime += 1ns; },
      [](Sent& s) { s.frame.duration += 1ns; },
      [](Sent& s) { s.frame.ethertype = 0x86dd; },
      [](Sent& s) {
        s.frame.payload = std::make_shared<const hal::Bytes>(hal::Bytes{0, 2, 3});
      },
      [](Sent& s) {
        s.frame.payload = std::make_shared<const hal::Bytes>(hal::Bytes{1, 2, 2});
      },
      [](Sent& s) {
        s.frame.payload = std::make_shared<const hal::Bytes>(hal::Bytes{1, 2, 3, 0});
      },
      [](Sent& s) { s.frame.payload = nullptr; },
  };
  std::set<std::uint64_t> digests{digest_of({a_frame()})};
  for (std::size_t i = 0; i < mutations.size(); ++i) {
    Sent mutated = a_frame();
    mutations[i](mutated);
    EXPECT_TRUE(digests.insert(digest_of({mutated})).second) << "mutation " << i;
  }
}

TEST(FrameDigest, TheOrderOfFramesOfOneInstantCounts) {
  Sent other = a_frame();
  other.frame.transmitter = AgentId{3};
  EXPECT_NE(digest_of({a_frame(), other}), digest_of({other, a_frame()}));
}

TEST(FrameDigest, AFrameThatIsCutOffCountsAndHowItIsReceivedDoesNot) {
  const Sent sent = a_frame();
  FrameDigest whole, cut, received;
  for (FrameDigest* const one : {&whole, &cut, &received}) one->on_frame_start(sent.at, sent.frame);
  cut.on_frame_cut(sent.at + 100us, sent.frame);
  received.on_reception(sent.at + 250us, sent.frame, AgentId{2}, hal::Verdict::kNoise, -70);
  EXPECT_NE(cut.value(), whole.value());
  EXPECT_EQ(received.value(), whole.value());
}

}  // namespace
