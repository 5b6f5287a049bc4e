#pragma once

#include <memory>

#include "hal/types/agent_id.h"
#include "hal/types/quantity.h"
#include "hal/types/random.h"
#include "hal/types/time.h"
#include "sim/radio/phy/phy_mode.h"
#include "sim/radio/rate/rate_control_config.h"
#include "sim/radio/rate/rate_ladder.h"

namespace sim::radio {

/// Chooses the mode of each attempt to send a unicast data frame from the results of earlier
/// attempts. To add a kind, add a class and a line in make_rate_control().
class RateControl {
 public:
  /// @param ladders  outlives this object.
  explicit RateControl(const RateLadders& ladders) : ladders_(ladders) {}
  virtual ~RateControl() = default;

  /// Mode of the next attempt. Its result is reported before the next call for this destination, or
  /// never.
  /// @param attempt  number of earlier attempts to send this frame.
  virtual const PhyMode& mode(hal::AgentId to, std::uint32_t attempt, hal::Time now) = 0;
  /// Mode of data that is likely to arrive. A BlockAckReq, which asks after a failure, is sent like
  /// the answer to such a frame.
  virtual const PhyMode& reliable_mode(hal::AgentId to, hal::Time now) { return mode(to, 0, now); }
  /// Reports whether the ACK was received.
  virtual void on_result(hal::AgentId to, bool is_success) = 0;
  /// Reports how many MPDUs of an A-MPDU were received, in place of on_result().
  virtual void on_aggregate(hal::AgentId to, std::uint32_t received, std::uint32_t sent) {
    (void)sent;
    on_result(to, received > 0);
  }

  /// Reports the SINR that the receiver had during the PPDU which it has answered, before
  /// on_result() or on_aggregate(). @param snr  the lowest over the PPDU, in its `width`, MHz.
  virtual void on_answer(hal::AgentId to, hal::Decibels snr, std::uint16_t width) {
    (void)to, (void)snr, (void)width;
  }

 protected:
  const Ladder& ladder(hal::AgentId to) const { return ladders_.to(to); }
  const std::vector<Ladder>& groups(hal::AgentId to) const { return ladders_.groups_to(to); }

 private:
  const RateLadders& ladders_;
};

/// Always uses the highest rate.
class FixedRate final : public RateControl {
 public:
  using RateControl::RateControl;
  const PhyMode& mode(hal::AgentId to, std::uint32_t, hal::Time) override {
    return *ladder(to).back().mode;
  }
  void on_result(hal::AgentId, bool) override {}
};

/// @param random  this station's stream, for kinds that draw.
std::unique_ptr<RateControl> make_rate_control(const RateControlConfig& config,
                                               const RateLadders& ladders,
                                               hal::RandomStream random);

}  // namespace sim::radio
