#pragma once

#include <cstdint>
#include <deque>
#include <map>

#include "sim/radio/mac/codel.h"

namespace sim::radio {

/// Flow queue CoDel (T. Hoeiland-Joergensen, P. McKenney, D. Taht, J. Gettys, E. Dumazet, IETF RFC
/// 8290, section 4): a queue with CoDel for each of `flows` values of the flow's hash; deficit
/// round robin over their bytes, in which flows that just began come first. Beyond its limits it
/// drops the oldest of the flow with most bytes.
class FqCodel final : public QueueDiscipline {
 public:
  /// @param config  outlives this object.   @param seed  of flow_hash().
  FqCodel(const FqCodelConfig& config, const QueueLimits& limits, std::uint64_t seed)
      : config_(config), limits_(limits), seed_(seed) {}

  bool accepts(const WaitingMsdu& msdu) const override { return msdu.bytes() <= limits_.bytes; }
  void push(WaitingMsdu msdu, DroppedMsdus& dropped) override;
  std::optional<WaitingMsdu> pop(hal::Time now, DroppedMsdus& dropped) override;
  void expire(hal::Time before, DroppedMsdus& dropped) override;
  std::size_t frames() const override { return frames_; }
  std::size_t bytes() const override { return bytes_; }

 private:
  struct Flow {
    explicit Flow(const FqCodelConfig& config) : codel(config) {}
    FlowQueue queue;
    Codel codel;
    std::int64_t deficit = 0;  ///< Bytes.
    bool is_listed = false;    ///< In new_ or old_.
  };

  std::uint32_t number_of(const WaitingMsdu& msdu) const;
  Flow& flow(std::uint32_t number) { return flows_.try_emplace(number, config_).first->second; }
  bool is_over() const { return frames_ > limits_.frames || bytes_ > limits_.bytes; }
  void drop_of_fattest(DroppedMsdus& dropped);
  void forget(const WaitingMsdu& msdu);
  void forget_from(std::size_t first, const DroppedMsdus& dropped);
  std::optional<WaitingMsdu> pop_of(Flow& flow, hal::Time now, DroppedMsdus& dropped);

  const FqCodelConfig& config_;
  QueueLimits limits_;
  std::uint64_t seed_;
  std::map<std::uint32_t, Flow> flows_;
  std::deque<std::uint32_t> new_, old_;  ///< Numbers of the flows that have a turn.
  std::size_t frames_ = 0;
  std::size_t bytes_ = 0;
};

}  // namespace sim::radio
