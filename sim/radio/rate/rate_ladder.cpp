#include "sim/radio/rate/rate_ladder.h"

#include <algorithm>
#include <utility>

#include "hal/types/check.h"
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
  const PhyMode& top = modes.data();
  Ladder all;
  for (const auto& mode : modes.all()) {
    if (!has_streams(mode->modulation_class()) && mode->rate() > top.reference_rate()) continue;
    const hal::Duration airtime = mode->airtime(bits);
    const hal::Duration ack = config.contention.sifs + modes.response_to(*mode).airtime(ack_bits);
    all.push_back({mode.get(), airtime, tries_of(airtime + ack, config.contention)});
  }
  const auto data = std::ranges::find(all, &top, &Rung::mode);
  BARAKA_CHECK(data != all.end());
  std::rotate(data, data + 1, all.end());
  return all;
}

RateLadders::RateLadders(const Ladder& all, const Cell& cell) : all_(all), cell_(cell) {
  BARAKA_CHECK(!all.empty());
  wanted_ = all.back().mode->id();
}

const Ladder& RateLadders::to(hal::AgentId station) const {
  const Capabilities receiver = cell_.capabilities(station);
  const auto found = std::ranges::find(made_, receiver, &Made::capabilities);
  if (found != made_.end()) return *found->ladder;
  made_.push_back({receiver, std::make_unique<Ladder>(ladder_for(receiver))});
  return *made_.back().ladder;
}

Ladder RateLadders::ladder_for(const Capabilities& receiver) const {
  const ModeId best = nearest(wanted_, receiver);
  return has_streams(best.modulation) ? mcs_ladder(best) : legacy_ladder(receiver);
}

Ladder RateLadders::legacy_ladder(const Capabilities& receiver) const {
  Ladder ladder;
  for (const Rung& rung : all_) {
    const ModulationClass modulation = rung.mode->modulation_class();
    if (!has_streams(modulation) && receiver.supports(modulation)) ladder.push_back(rung);
  }
  BARAKA_CHECK(!ladder.empty());
  return ladder;
}

Ladder RateLadders::mcs_ladder(const ModeId& best) const {
  Ladder ladder;
  for (const Rung& rung : all_) {
    const ModeId& id = rung.mode->id();
    const bool is_of_it =
        id.modulation == best.modulation && id.width == best.width && id.guard == best.guard;
    if (is_of_it && id.streams <= best.streams && id.mcs <= best.mcs) ladder.push_back(rung);
  }
  BARAKA_CHECK(!ladder.empty());
  const auto rate = [](const Rung& rung) { return rung.mode->rate().value; };
  std::ranges::stable_sort(
      ladder, {}, [&](const Rung& rung) { return std::pair(rate(rung), rung.mode->id().streams); });
  Ladder rising;
  for (const Rung& rung : ladder) {
    if (rising.empty() || rate(rung) > rate(rising.back())) rising.push_back(rung);
  }
  return rising;
}

}  // namespace sim::radio
