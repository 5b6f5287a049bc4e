#pragma once

#include <cstdint>

#include "hal/types/geometry.h"
#include "hal/types/quantity.h"
#include "hal/types/time.h"
#include "sim/radio/ports.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// Level of a power. Zero mW is -infinity dBm.
hal::Dbm to_dbm(hal::Milliwatts power);
hal::Milliwatts to_milliwatts(hal::Dbm level);

/// From one antenna to another: what arrives of a frame.
///
/// mobility_framework and ieee80211b: Friis' power law, P = Ptx lambda^2 / (16 pi^2 d^alpha) with d
/// in metres, never more than Ptx (H. T. Friis, "A Note on a Simple Transmission Formula", Proc.
/// IRE, 1946; exponent on the distance only as in the Mobility Framework), less the loss of walls.
/// disk and ideal: Ptx within the range, nothing beyond.
class Propagation {
 public:
  Propagation(const RadioConfig& config, const Obstacles& obstacles);

  enum class Strength : std::uint8_t {
    kNothing,  ///< Below the interference floor.
    kFaint,    ///< Interference, and energy together with others.
    kAudible,  ///< Can be received, or sensed by itself, or would but for walls.
  };
  struct Arrival {
    hal::Milliwatts power{};  ///< 0 below the interference floor.
    hal::Dbm level{};         ///< If audible. Not cut at the floor.
    hal::Duration delay{};
    Strength strength = Strength::kNothing;
    bool blocked = false;  ///< Only walls keep it below the sensitivity.
  };
  Arrival arrival(const hal::Vec3& from, const hal::Vec3& to) const;

  /// Nobody further away than this notices a frame. May be infinite.
  hal::Metres reach() const { return reach_; }

  /// Distance at which the power law gives this level.
  hal::Metres distance_at(hal::Dbm level) const;

  /// Strong enough for anybody to notice.
  bool is_noticeable(hal::Milliwatts power) const { return power >= floor_; }
  /// Strong enough to be received.
  bool is_receivable(hal::Milliwatts power) const { return power >= sensitivity_; }

 private:
  hal::Milliwatts free_space(double distance_squared) const;
  double spread(double distance_squared) const;
  Strength strength(const Arrival& arrival) const;

  const Obstacles* obstacles_;  ///< Null: walls do not matter.
  bool disk_;
  bool delays_;
  double tx_power_;
  double exponent_;
  double at_one_metre_;  ///< mW
  hal::Milliwatts sensitivity_;
  hal::Milliwatts floor_;
  hal::Milliwatts audible_;
  hal::Metres reach_;
};

}  // namespace sim::radio
