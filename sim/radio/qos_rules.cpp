#include "sim/radio/qos_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "sim/radio/infrastructure/edca_element.h"
#include "sim/radio/phy/mcs_modes.h"

namespace sim::radio {
namespace {

constexpr std::uint32_t kMaxAifsn = 15;  // IEEE Std 802.11-2020, 9.4.2.28
constexpr std::uint32_t kMaxBlockAckWindow = 64, kMaxHeBlockAckWindow = 256;
/// Longest A-MSDU of HT, 9.4.2.55.3.
constexpr std::uint32_t kMaxAmsdu = 7935;

/// Whether every rate is of OFDM, as it must be in 5 GHz.
bool are_ofdm(const HtConfig& c) {
  const auto is_ofdm = [](hal::BitsPerSecond rate) { return !is_dsss_rate(rate); };
  return is_ofdm(c.phy.control_rate) && is_ofdm(c.phy.broadcast_rate) &&
         std::ranges::all_of(c.basic_rates, is_ofdm) &&
         is_ofdm(c.beacon_rate.value_or(c.phy.broadcast_rate));
}

}  // namespace

void ask_window(Rules& rules, std::string_view key, std::uint32_t window) {
  rules.ask(window < (1u << 16) && std::has_single_bit(window + 1), key,
            fmt::format("{} is not one less than a power of two", window));
}

void ask_edca(Rules& rules, const EdcaConfig& edca) {
  for (const AccessParameters& c : edca.categories) {
    ask_window(rules, "edca", c.cw_min);
    ask_window(rules, "edca", c.cw_max);
    rules.ask(c.cw_min <= c.cw_max, "edca", "must not have a cw_max below its cw_min");
    rules.ask(c.aifsn >= 1 && c.aifsn <= kMaxAifsn, "edca",
              fmt::format("must have an aifsn of 1 .. {}", kMaxAifsn));
    rules.ask(c.txop_limit >= hal::Duration{}, "edca", "must not have a negative txop_limit");
    rules.ask(!c.msdu_lifetime || *c.msdu_lifetime > hal::Duration{}, "edca",
              "must have a positive msdu_lifetime, or none");
  }
}

void ask_announced_edca(Rules& rules, const std::optional<EdcaConfig>& edca) {
  if (!edca) return;
  const std::string_view key = "bss.edca";
  for (const AccessParameters& c : edca->categories) {
    ask_window(rules, key, c.cw_min);
    ask_window(rules, key, c.cw_max);
    rules.ask(c.cw_min <= c.cw_max && c.cw_max < 1u << 15, key,
              "must have a cw_max of at most 32767 that is not below its cw_min");
    rules.ask(c.aifsn >= 2 && c.aifsn <= kMaxAifsn, key,
              fmt::format("must have an aifsn of 2 .. {}", kMaxAifsn));
    rules.ask(c.txop_limit >= hal::Duration{} && c.txop_limit <= kLongestTxop &&
                  c.txop_limit % kTxopUnit == hal::Duration{},
              key, "must have a txop_limit of 0 to 65535 times 32 us");
  }
}

void ask_queues(Rules& rules, const QueuesConfig& c) {
  constexpr hal::Duration kNothing{};
  const bool is_plain = c.discipline == Discipline::kFifo && !c.limit && !c.limit_bytes;
  rules.ask(c.per == QueuePer::kStation || (is_plain && !c.airtime_fairness), "queues.per",
            "must be station for a discipline, limit, limit_bytes or airtime_fairness");
  rules.ask(!c.limit || *c.limit >= 1, "queues.limit", "must be 1 or more");
  rules.ask(!c.limit_bytes || *c.limit_bytes >= 1, "queues.limit_bytes", "must be 1 or more");
  const FqCodelConfig& codel = c.fq_codel;
  rules.ask(codel.target > kNothing, "queues.target", "must be positive");
  rules.ask(codel.target < codel.interval, "queues.target", "must be shorter than the interval");
  rules.ask(codel.quantum >= 1, "queues.quantum", "must be 1 or more");
  rules.ask(codel.flows >= 1, "queues.flows", "must be 1 or more");
  rules.ask(c.airtime_quantum > kNothing, "queues.airtime_quantum", "must be positive");
}

void ask_mcs(Rules& rules, const HtConfig& c) {
  const McsConfig& mcs = c.mcs;
  rules.ask(mcs.mcs <= highest_mcs(c.modulation), "mcs",
            fmt::format("must be 0 .. {}", highest_mcs(c.modulation)));
  rules.ask(mcs.streams >= 1 && mcs.streams <= 4, "streams", "must be 1 .. 4");
  const bool has_guard = c.modulation == ModulationClass::kHe
                             ? mcs.guard == 800ns || mcs.guard == 1600ns || mcs.guard == 3200ns
                             : mcs.guard == 400ns || mcs.guard == 800ns;
  rules.ask(has_guard, "guard_interval",
            c.modulation == ModulationClass::kHe ? "must be 800 ns, 1600 ns or 3200 ns"
                                                 : "must be 400 ns or 800 ns");
  const bool is_width = has_width(c.phy.channel, mcs.width) &&
                        (c.modulation != ModulationClass::kHt || mcs.width <= 40);
  rules.ask(is_width, "width",
            fmt::format("cannot be {} MHz on channel {}", mcs.width, c.phy.channel));
  const bool is_possible = exists({c.modulation, mcs.mcs, mcs.streams, mcs.width, mcs.guard});
  rules.ask(
      is_possible || !rules.is_empty(), "mcs",
      fmt::format("{} does not exist in {} MHz with {} streams", mcs.mcs, mcs.width, mcs.streams));
  rules.ask(!is_5ghz(c.phy.channel) || are_ofdm(c), "basic_rates",
            "and the other rates must be of OFDM in 5 GHz: 6 Mb/s or more");
}

void ask_aggregation(Rules& rules, const HtConfig& c) {
  const AggregationConfig& a = c.aggregation;
  const std::uint32_t window =
      c.modulation == ModulationClass::kHe ? kMaxHeBlockAckWindow : kMaxBlockAckWindow;
  rules.ask(a.block_ack_window >= 1 && a.block_ack_window <= window, "aggregation.block_ack_window",
            fmt::format("must be 1 .. {}", window));
  rules.ask(a.max_amsdu <= kMaxAmsdu, "aggregation.max_amsdu",
            fmt::format("must be 0 .. {}", kMaxAmsdu));
  rules.ask(a.reorder_timeout > hal::Duration{}, "aggregation.reorder_timeout", "must be positive");
}

}  // namespace sim::radio
