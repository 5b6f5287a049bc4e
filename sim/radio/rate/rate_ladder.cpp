#include "sim/radio/rate/rate_ladder.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "hal/types/check.h"
#include "sim/radio/mac/aggregation.h"
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

AverageExchange average_exchange(const Rung& rung, std::uint32_t mpdus) {
  if (mpdus <= 1) return {1, rung.mode->airtime(rung.bits) + rung.answer};
  const std::uint32_t subframe =
      Aggregation::with_subframe(0, Aggregation::subframe_begin(rung.bits));
  const hal::Duration airtime = rung.mode->airtime(mpdus * subframe);
  const hal::Duration most = rung.mode->longest_ppdu();
  if (airtime <= most) return {static_cast<double>(mpdus), airtime + rung.answer};
  const double share = hal::to_seconds(most) / hal::to_seconds(airtime);
  if (share * mpdus < 1) return average_exchange(rung, 1);
  return {share * mpdus, most + rung.answer};
}

Ladder make_ladder(const DcfConfig& config, const ModeSet& modes) {
  const std::uint32_t bits = mpdu_bits(config.lengths, FrameType::kData, kAverageMsdu);
  const std::uint32_t ack_bits = mpdu_bits(config.lengths, FrameType::kAck);
  const PhyMode& top = modes.data();
  Ladder all;
  for (const auto& mode : modes.all()) {
    if (!has_streams(mode->modulation_class()) && mode->rate() > top.reference_rate()) continue;
    const hal::Duration airtime = mode->airtime(bits);
    const hal::Duration ack = config.contention.sifs + modes.response_to(*mode).airtime(ack_bits);
    all.push_back({mode.get(), airtime, tries_of(airtime + ack, config.contention),
                   bits + kQosControlBits, ack});
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

const RateLadders::Made& RateLadders::made(hal::AgentId station) const {
  const Capabilities receiver = cell_.capabilities(station);
  const auto found = std::ranges::find(made_, receiver, &Made::capabilities);
  if (found != made_.end()) return *found;
  made_.push_back({receiver, std::make_unique<Ladder>(ladder_for(receiver)),
                   std::make_unique<std::vector<Ladder>>(groups_for(receiver))});
  return made_.back();
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

std::vector<Ladder> RateLadders::groups_for(const Capabilities& receiver) const {
  const ModeId best = nearest(wanted_, receiver);
  if (!has_streams(best.modulation)) return {};
  const auto group_of = [](const Rung& rung) {
    const ModeId& id = rung.mode->id();
    return std::tuple(id.streams, id.width, -id.guard.count());
  };
  std::map<decltype(group_of(Rung{})), Ladder> groups;
  for (const Rung& rung : all_) {
    const ModeId& id = rung.mode->id();
    const bool is_of_it = id.modulation == best.modulation && id.mcs <= best.mcs;
    if (!is_of_it || id.width > best.width || id.streams > best.streams) continue;
    if (id.guard < best.guard || !receiver.supports(id)) continue;
    groups[group_of(rung)].push_back(rung);
  }
  std::vector<Ladder> in_order;
  for (auto& [key, ladder] : groups) {
    std::ranges::sort(ladder, {}, [](const Rung& rung) { return rung.mode->id().mcs; });
    in_order.push_back(std::move(ladder));
  }
  return in_order;
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
