#include "sim/radio/rate/rate_ladder.h"

#include "sim/radio/mac/backoff.h"
#include "sim/radio/mac/frame_lengths.h"

namespace sim::radio {
namespace {

// Values of Linux's minstrel.
constexpr std::size_t kAverageMsdu = 1200;  // bytes
constexpr hal::Duration kSegment = 6ms;
constexpr std::uint32_t kMostTries = 7;

/// Number of exchanges that fit into kSegment, with a mean backoff before each but the first.
std::uint32_t tries_of(hal::Duration exchange, const ContentionConfig& mac) {
  ContentionWindow window(mac.cw_min, mac.cw_max);
  hal::Duration spent = exchange;
  std::uint32_t tries = 1;
  while (tries < kMostTries) {
    spent += exchange + mac.slot * window.value() / 2;
    if (spent >= kSegment) break;
    window.grow();
    ++tries;
  }
  return tries;
}

}  // namespace

Ladder make_ladder(const DcfConfig& config, const ModeSet& modes) {
  const std::uint32_t bits = mpdu_bits(config.lengths, FrameType::kData, kAverageMsdu);
  const std::uint32_t ack_bits = mpdu_bits(config.lengths, FrameType::kAck);
  Ladder all;
  for (const auto& mode : modes.all()) {
    if (mode->rate() > config.phy.data_rate) break;
    const hal::Duration airtime = mode->airtime(bits);
    const hal::Duration ack = config.contention.sifs + modes.response_to(*mode).airtime(ack_bits);
    all.push_back({mode.get(), airtime, tries_of(airtime + ack, config.contention)});
  }
  return all;
}

}  // namespace sim::radio
