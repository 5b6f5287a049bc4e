#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "hal/types/quantity.h"
#include "hal/types/time.h"
#include "sim/core/ground.h"
#include "sim/radio/channel/path_loss.h"
#include "sim/radio/channel/ports.h"
#include "sim/radio/channel/wall_losses.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// Level of a power. Zero mW is -infinity dBm.
hal::Dbm to_dbm(hal::Milliwatts power);
hal::Milliwatts to_milliwatts(hal::Dbm level);

/// From one antenna to another: what arrives of a frame. A chain of path losses, then the walls: by
/// the multi-wall law if the chain has it, else, with `obstacles`, by their own losses.
///
/// mobility_framework and ieee80211b: the chain of their config (path_loss_config.h). disk and
/// ideal: Cutoff.
///
/// What depends only on where the two ends are is a Steady, computed when one has moved. The rest,
/// fading in time and bodies in the way, is looked at when a frame starts, and only where it is
/// audible: elsewhere frames keep their mean.
class Propagation {
 public:
  /// @param obstacles, ground  outlive this.
  Propagation(const RadioConfig& config, const Obstacles& obstacles,
              const Ground& ground = *kFlatGround);

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
  /// What holds as long as neither end moves.
  struct Steady {
    hal::Milliwatts free{};                  ///< Without walls.
    double walls = 1;                        ///< What walls leave of it, as a share.
    double distance_squared = 0;             ///< m^2
    Strength strength = Strength::kNothing;  ///< Of the most that it may become.
  };
  /// @param sent  by the antenna at `from`; the gains of antennas that are not equal in all
  /// directions are added.
  Steady steady(hal::Milliwatts sent, const Site& from, const Site& to) const;
  /// The same at a distance, m. @pre falls_with_distance()
  Steady steady_at(hal::Milliwatts sent, double distance) const;

  /// Whether a Steady depends on nothing but the distance, and leaves no more at a greater one.
  bool falls_with_distance() const {
    return obstacles_ == nullptr && chain_.size() == 1 && chain_.front()->falls_with_distance();
  }

  /// @param at  now.
  Arrival arrival(const Steady& steady, const Site& from, const Site& to, hal::Time at) const;
  Arrival arrival(hal::Milliwatts sent, const Site& from, const Site& to, hal::Time at = {}) const {
    return arrival(steady(sent, from, to), from, to, at);
  }

  /// Power and delay of an arrival where frames keep their mean: all but audible ones.
  Arrival mean_arrival(const Steady& steady) const;

  /// Whether arrivals change although neither end moves.
  bool changes_in_time() const { return moving_obstacles_ != nullptr || !in_time_.empty(); }

  /// mean_arrival() of steady(), computed for many. `level` and `blocked` are not set.
  /// @pre falls_with_distance()
  [[gnu::always_inline]] Arrival quick_arrival(hal::Milliwatts sent, const Site& from,
                                               const Site& to) const {
    const Path path(from, to);
    const hal::Milliwatts power = chain_.front()->after(sent, path);
    const hal::Milliwatts most = most_in_time_ * power;
    Arrival result;
    if (most < floor_) return result;
    result.strength = most >= audible_ ? Strength::kAudible : Strength::kFaint;
    if (power >= floor_) result.power = power;
    result.delay = delay(path.distance_squared);
    return result;
  }

  /// Nobody further away than this notices a frame that is sent with this power, m. May be
  /// infinite.
  double reach(hal::Milliwatts sent) const { return reach(sent, floor_); }

  /// At no greater distance, m, so much arrives, walls apart.
  double reach(hal::Milliwatts sent, hal::Milliwatts least) const;

  /// Distances, m, between which a signal is faint: estimates, as of reach().
  struct FaintRange {
    hal::Milliwatts sent{};
    double nearest = 0, farthest = 0;
  };
  FaintRange faint_range(hal::Milliwatts sent) const {
    return {sent, reach(sent, audible_), reach(sent, floor_)};
  }

  /// Strong enough to be received.
  bool is_receivable(hal::Milliwatts power) const { return power >= sensitivity_; }

 private:
  using Chain = std::vector<std::unique_ptr<const PathLoss>>;

  void add(const WavesConfig& config, const Obstacles& obstacles, const Ground& ground);
  void add(hal::Metres range);
  void add(std::unique_ptr<const PathLoss> loss);
  Strength strength(const Steady& steady) const;
  hal::Duration delay(double distance_squared) const {
    constexpr double kSpeedOfLight = 299792458.0;  // m/s
    if (!delays_) return {};
    return hal::from_seconds(std::sqrt(distance_squared) / kSpeedOfLight);
  }
  bool is_blocked(hal::Milliwatts free, hal::Milliwatts left) const {
    return is_receivable(free) && !is_receivable(left);
  }

  std::unique_ptr<const WallLosses> wall_losses_;  ///< With a multi-wall law.
  Chain chain_, in_time_;                          ///< Of what is steady, and of the rest.
  double most_gain_ = 1;                           ///< Of both chains.
  double most_in_time_ = 1;                        ///< Of the second one.
  const Obstacles* obstacles_ = nullptr;           ///< Null: walls do not matter.
  const Obstacles* moving_obstacles_ = nullptr;    ///< Null: bodies do not matter.
  bool delays_ = false;
  hal::Milliwatts sensitivity_{};
  hal::Milliwatts floor_{};
  hal::Milliwatts audible_{};
};

}  // namespace sim::radio
