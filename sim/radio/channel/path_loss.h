#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "hal/types/agent_id.h"
#include "hal/types/geometry.h"
#include "hal/types/quantity.h"
#include "hal/types/time.h"
#include "sim/core/ground.h"

namespace sim::radio {

struct PropagationConfig;
class DirectedAntenna;

/// Kind of an entry in a propagation chain. Each model has its kind in `kKind` and its name in
/// files in `kModel`.
enum class PathLossKind : std::uint8_t {
  kLawOfDistance,  ///< Power decreases with distance without limit. A chain has exactly one.
  kOfLinks,        ///< Constant for a link whose ends do not move; differs between links.
  kFading,         ///< Each link fades in time. A chain has at most one.
};

/// An antenna where it stands.
struct Site {
  /// @param the_position  m, world frame, of what carries it. @param the_height  m above that.
  // NOLINTNEXTLINE(google-explicit-constructor): a place is a site without more said of it.
  Site(const hal::Vec3& the_position, double the_height = 0, std::uint64_t the_name = 0,
       hal::AgentId the_agent = {})
      : position(the_position), height(the_height), name(the_name), agent(the_agent) {}

  hal::Vec3 antenna() const { return {position.x, position.y, position.z + height}; }

  hal::Vec3 position;
  double height;
  std::uint64_t name;  ///< Of the station, with the run's seed: names the randomness of its links.
  hal::AgentId agent;
  const DirectedAntenna* directed = nullptr;  ///< Null: equal in all directions.
};

/// From one antenna to another, at an instant. World frame, m.
struct Path {
  Path(const Site& the_from, const Site& the_to, hal::Time the_time = {})
      : from(the_from), to(the_to), at(the_time) {
    hal::Vec3 way = to.position - from.position;
    way.z += to.height - from.height;
    distance_squared = hal::dot(way, way);
  }

  /// Names the randomness of the link; the same in both directions.
  std::uint64_t link() const {
    // Odd factor: another order of the two names would be another link, so they are put in order.
    return first().name * 0x9e3779b97f4a7c15u + second().name;
  }
  const Site& first() const { return from.name < to.name ? from : to; }
  const Site& second() const { return from.name < to.name ? to : from; }

  const Site& from;
  const Site& to;
  hal::Time at;
  double distance_squared;  ///< m^2
};

/// A link of the chain of propagation: what is left of a power after the way. The first one gets
/// what the transmitter sends, each other one what the one before it left.
class PathLoss {
 public:
  virtual ~PathLoss() = default;

  /// @param power  mW, > 0. @return at most most_gain() times that.
  virtual hal::Milliwatts after(hal::Milliwatts power, const Path& path) const = 0;

  /// At no greater distance, m, more than `least` is left of `power` if nothing gains; may be
  /// infinite.
  virtual double reach(hal::Milliwatts power, hal::Milliwatts least) const = 0;

  /// By how much it may strengthen, >= 1.
  virtual double most_gain() const { return 1; }

  /// Whether it depends on nothing but the distance, and leaves no more at a greater one.
  virtual bool falls_with_distance() const { return false; }

  /// Whether the same places may give something else at another time.
  virtual bool changes_in_time() const { return false; }
};

}  // namespace sim::radio
