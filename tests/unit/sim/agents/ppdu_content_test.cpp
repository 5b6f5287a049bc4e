#include "sim/agents/ppdu_content.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <vector>

#include "sim/agents/fingerprint_feed.h"
#include "sim/agents/frame_digest.h"
#include "sim/radio/phy/ht_mode.h"
#include "sim/radio/phy/vht_mode.h"

namespace {

using namespace std::chrono_literals;
using hal::AgentId;
using sim::radio::AmsduPart;
using sim::radio::BlockAckFields;
using sim::radio::Frame;
using sim::radio::ModeId;
using sim::radio::ModulationClass;

sim::radio::Payload bytes(std::uint8_t first) {
  return std::make_shared<const hal::Bytes>(hal::Bytes{first, 2, 3});
}

template <class Mode>
const Mode& mode_of(const ModeId& id) {
  static std::vector<std::unique_ptr<Mode>> modes;
  modes.push_back(std::make_unique<Mode>(id, typename Mode::Options{}));
  return *modes.back();
}

constexpr ModeId kHt{ModulationClass::kHt, 3, 1, 20, 800ns};

/// A frame with everything that a PPDU of the newer standards can have; BlockAcks are not data, but
/// each field counts by itself.
struct SentWhole {
  Frame frame;
  BlockAckFields block_ack{.tid = 5, .start = 7, .length = 64};
  std::vector<AmsduPart> amsdu;

  SentWhole() {
    frame.transmitter = AgentId{1};
    frame.receiver = AgentId{2};
    frame.qos = true;
    frame.priority = 5;
    frame.ampdu = 4;
    frame.payload = bytes(1);
    frame.mode = &mode_of<sim::radio::HtMode>(kHt);
    block_ack.received[3] = true;
    for (const std::uint8_t first : {std::uint8_t{1}, std::uint8_t{9}}) {
      amsdu.push_back({.source = AgentId{1},
                       .destination = AgentId{2},
                       .ethertype = 0x0800,
                       .payload = bytes(first)});
    }
  }
  Frame whole() const {
    Frame all = frame;
    all.block_ack = std::make_shared<const BlockAckFields>(block_ack);
    all.amsdu = std::make_shared<const std::vector<AmsduPart>>(amsdu);
    return all;
  }
};

void use_mode(SentWhole& sent, const ModeId& id) {
  sent.frame.mode = &mode_of<sim::radio::HtMode>(id);
}

using FrameMutation = std::function<void(SentWhole&)>;
const std::vector<FrameMutation> kMutations = {
    [](SentWhole& s) { s.frame.qos = false; },
    [](SentWhole& s) { s.frame.priority = 6; },
    [](SentWhole& s) { s.frame.ampdu = 5; },
    [](SentWhole& s) { s.frame.is_last_of_ampdu = true; },
    [](SentWhole& s) { s.block_ack.tid = 6; },
    [](SentWhole& s) { s.block_ack.start = 8; },
    [](SentWhole& s) { s.block_ack.length = 256; },
    [](SentWhole& s) { s.block_ack.received.flip(3); },
    [](SentWhole& s) { s.block_ack.received.flip(63); },
    [](SentWhole& s) { s.amsdu.pop_back(); },
    [](SentWhole& s) { std::swap(s.amsdu[0], s.amsdu[1]); },
    [](SentWhole& s) { s.amsdu[1].source = AgentId{3}; },
    [](SentWhole& s) { s.amsdu[1].destination = AgentId{3}; },
    [](SentWhole& s) { s.amsdu[1].ethertype = 0x86dd; },
    [](SentWhole& s) { s.amsdu[1].payload = bytes(8); },
    // The same rate in another mode.
    [](SentWhole& s) { s.frame.mode = nullptr; },
    [](SentWhole& s) {
      use_mode(s, {ModulationClass::kHt, 2, 1, 20, 800ns});
    },
    [](SentWhole& s) {
      use_mode(s, {ModulationClass::kHt, 3, 2, 20, 800ns});
    },
    [](SentWhole& s) {
      use_mode(s, {ModulationClass::kHt, 3, 1, 40, 800ns});
    },
    [](SentWhole& s) {
      use_mode(s, {ModulationClass::kHt, 3, 1, 20, 400ns});
    },
    [](SentWhole& s) {
      s.frame.mode = &mode_of<sim::radio::VhtMode>({ModulationClass::kVht, 3, 1, 20, 800ns});
    },
};

std::uint64_t digest_of(const SentWhole& sent) {
  sim::agents::FrameDigest digest;
  digest.on_frame_start(hal::Time{1s}, sent.whole());
  return digest.value();
}

std::uint64_t fingerprint_of(const SentWhole& sent) {
  sim::agents::FingerprintFeed feed;
  feed.on_frame_start(hal::Time{1s}, sent.whole());
  return feed.fingerprint().total();
}

void expect_all_differ(std::uint64_t (*hash_of)(const SentWhole&)) {
  std::set<std::uint64_t> hashes{hash_of({})};
  EXPECT_EQ(hash_of({}), *hashes.begin());
  for (std::size_t i = 0; i < kMutations.size(); ++i) {
    SentWhole mutated;
    kMutations[i](mutated);
    EXPECT_TRUE(hashes.insert(hash_of(mutated)).second) << "mutation " << i;
  }
}

TEST(PpduContent, EachFieldCountsInTheDigest) { expect_all_differ(digest_of); }
TEST(PpduContent, EachFieldCountsInTheFingerprint) { expect_all_differ(fingerprint_of); }

TEST(PpduContent, FramesWithoutAnyOfItKeepTheirHash) {
  Frame plain;
  plain.priority = 3;
  sim::Hash hash;
  const std::uint64_t before = hash.value();
  sim::agents::add_ppdu(hash, plain);
  EXPECT_EQ(hash.value(), before);
}

}  // namespace
