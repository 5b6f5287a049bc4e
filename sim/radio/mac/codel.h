#pragma once

#include <cstdint>
#include <optional>

#include "hal/types/time.h"
#include "sim/radio/mac/queue_discipline.h"

namespace sim::radio {

/// Controlled delay (K. Nichols, V. Jacobson, A. McGregor, J. Iyengar, IETF RFC 8289, section 5):
/// once MSDUs have waited longer than `target` for an `interval`, it drops one, and the next ones
/// after interval / sqrt(1), interval / sqrt(2), …, until one has waited less.
class Codel {
 public:
  /// @param config  outlives this object.
  explicit Codel(const FqCodelConfig& config) : config_(config) {}

  /// Takes out the next MSDU. @param dropped  gets those before it that have to go (kQueueDelay).
  std::optional<WaitingMsdu> pop(FlowQueue& queue, hal::Time now, DroppedMsdus& dropped);

 private:
  struct Popped {
    std::optional<WaitingMsdu> msdu;
    bool may_drop = false;
  };
  Popped pop_one(FlowQueue& queue, hal::Time now);
  hal::Time next_drop(hal::Time after) const;
  void go_on(Popped& popped, FlowQueue& queue, hal::Time now, DroppedMsdus& dropped);
  void begin(Popped& popped, FlowQueue& queue, hal::Time now, DroppedMsdus& dropped);

  const FqCodelConfig& config_;
  std::optional<hal::Time> above_until_;  ///< When the delay will have been too long for long.
  hal::Time drop_next_{};
  std::uint32_t count_ = 0;  ///< Drops since dropping began.
  std::uint32_t last_count_ = 0;
  bool is_dropping_ = false;
};

}  // namespace sim::radio
