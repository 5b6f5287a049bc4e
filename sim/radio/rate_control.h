#pragma once

#include <memory>

#include "hal/types/agent_id.h"
#include "hal/types/random.h"
#include "hal/types/time.h"
#include "sim/radio/phy_mode.h"
#include "sim/radio/rate_control_config.h"
#include "sim/radio/rate_ladder.h"

namespace sim::radio {

/// Chooses the mode of each attempt to send a unicast data frame, from what became of those before.
/// A new kind is a class and a line in make_rate_control().
class RateControl {
 public:
  /// @param ladders  outlive it.
  explicit RateControl(const RateLadders& ladders) : ladders_(ladders) {}
  virtual ~RateControl() = default;

  /// Of the next attempt, whose result is told before the next call for this destination, or never.
  /// @param attempt  from 0 on, of this frame.
  virtual const PhyMode& mode(hal::AgentId to, std::uint32_t attempt, hal::Time now) = 0;
  /// The ACK came, or did not.
  virtual void on_result(hal::AgentId to, bool is_success) = 0;

 protected:
  const Ladder& ladder(hal::AgentId to) const { return ladders_.to(to); }

 private:
  const RateLadders& ladders_;
};

/// Always the highest.
class FixedRate final : public RateControl {
 public:
  using RateControl::RateControl;
  const PhyMode& mode(hal::AgentId to, std::uint32_t, hal::Time) override {
    return *ladder(to).back().mode;
  }
  void on_result(hal::AgentId, bool) override {}
};

/// @param random  of this station, for those that draw.
std::unique_ptr<RateControl> make_rate_control(const RateControlConfig& config,
                                               const RateLadders& ladders,
                                               hal::RandomStream random);

}  // namespace sim::radio
