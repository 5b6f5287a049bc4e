#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "hal/types/quantity.h"
#include "hal/types/time.h"
#include "sim/radio/path_loss.h"
#include "sim/radio/ports.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// Level of a power. Zero mW is -infinity dBm.
hal::Dbm to_dbm(hal::Milliwatts power);
hal::Milliwatts to_milliwatts(hal::Dbm level);

/// From one antenna to another: what arrives of a frame. A chain of path losses, then the walls.
///
/// mobility_framework and ieee80211b: PowerLaw. disk and ideal: Cutoff. A new law of propagation is
/// a class of path loss and a line where the chain is made.
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
  /// @param sent  by the antenna at `from`.
  Arrival arrival(hal::Milliwatts sent, const hal::Vec3& from, const hal::Vec3& to) const;

  /// Nobody further away than this notices a frame that is sent with this power, m. May be
  /// infinite.
  double reach(hal::Milliwatts sent) const { return reach(sent, floor_); }

  /// At no greater distance, m, so much arrives, walls apart.
  double reach(hal::Milliwatts sent, hal::Milliwatts least) const;

  /// Strong enough to be received.
  bool is_receivable(hal::Milliwatts power) const { return power >= sensitivity_; }

 private:
  void add(const WavesConfig& config, const Obstacles& obstacles);
  void add(hal::Metres range);
  Strength strength(const Arrival& arrival) const;

  std::vector<std::unique_ptr<const PathLoss>> chain_;  ///< Not empty.
  const Obstacles* obstacles_ = nullptr;                ///< Null: walls do not matter.
  bool delays_ = false;
  hal::Milliwatts sensitivity_{};
  hal::Milliwatts floor_{};
  hal::Milliwatts audible_{};
};

}  // namespace sim::radio
