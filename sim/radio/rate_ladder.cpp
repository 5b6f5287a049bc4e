#include "sim/radio/rate_ladder.h"

#include "sim/radio/dcf_timing.h"
#include "sim/radio/frame_lengths.h"
#include "sim/radio/protection.h"

namespace sim::radio {
namespace {

/// Of which the rungs tell the cost, as Linux's minstrel does.
constexpr std::size_t kAverageMsdu = 1200;  // bytes

}  // namespace

Ladder make_ladder(const DcfConfig& config, const ModeSet& modes, const Cell& cell) {
  const DcfTiming timing(config, modes);
  const Protection protection(config, modes, cell);
  const std::uint32_t bits = mpdu_bits(config.lengths, FrameType::kData, kAverageMsdu);
  const auto airtime = [&](FrameType type, const PhyMode& mode) {
    return mode.airtime(mpdu_bits(config.lengths, type)) + timing.sifs;
  };
  Ladder all;
  for (const auto& mode : modes.all()) {
    if (mode->rate() > config.phy.data_rate) break;
    hal::Duration cost =
        timing.difs + mode->airtime(bits) + airtime(FrameType::kAck, modes.response_to(*mode));
    const Opening opening = protection.opening(false, *mode, bits);
    const PhyMode& first = protection.mode(hal::kEveryone, *mode);
    if (opening != Opening::kNone) cost += airtime(FrameType::kCts, modes.response_to(first));
    if (opening == Opening::kRts) cost += airtime(FrameType::kRts, first);
    all.push_back({mode.get(), cost});
  }
  return all;
}

}  // namespace sim::radio
