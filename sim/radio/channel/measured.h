#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "sim/radio/channel/friis.h"
#include "sim/radio/channel/log_distance.h"
#include "sim/radio/channel/path_loss.h"
#include "sim/radio/channel/power_law.h"
#include "sim/radio/channel/two_ray_ground.h"
#include "sim/radio/channel/two_ray_interference.h"

namespace sim::radio {

/// The loss of one link at one time.
struct MeasuredRow {
  std::string from, to;  ///< Names of stations.
  double at = 0;         ///< s, >= 0
  double loss = 0;       ///< dB, >= 0, from antenna to antenna.
  std::string place{};   ///< In a file, for messages.
};

/// Between two rows of a link.
enum class MeasuredBetween : std::uint8_t {
  kHold,    ///< The loss of the earlier one.
  kLinear,  ///< Linear in dB.
};

/// Loss of each link as measured.
struct MeasuredConfig {
  static constexpr std::string_view kModel = "measured";
  static constexpr PathLossKind kKind = PathLossKind::kLawOfDistance;
  using Otherwise = std::variant<PowerLawConfig, FriisConfig, LogDistanceConfig, TwoRayGroundConfig,
                                 TwoRayInterferenceConfig>;

  /// Shared by copies; null: none.
  std::shared_ptr<const std::vector<MeasuredRow>> rows;
  bool has_times = false;  ///< Whether rows differ in time; else each link has one.
  MeasuredBetween between = MeasuredBetween::kHold;
  /// Where a link has no row for longer, nothing arrives until its next one; nullopt: never so.
  std::optional<hal::Duration> silence{};
  std::optional<Otherwise> otherwise{};  ///< For links without rows; nullopt: nothing arrives.
  /// Names of the stations; RadioNetwork sets them.
  std::vector<std::pair<hal::AgentId, std::string>> stations{};
};

std::unique_ptr<const PathLoss> make(const MeasuredConfig& config, const PropagationConfig& air,
                                     const Ground& ground);

/// Losses of links from a survey or a drive. A link has the rows of its direction, without any
/// those of the other direction, without any the law `otherwise`. Before its first row it has the
/// loss of that, after its last row the loss of the last.
/// A trace of received frames has no rows where none was received: `silence` keeps them so.
class Measured final : public PathLoss {
 public:
  /// @param otherwise  null: nothing arrives on links without rows.
  Measured(const MeasuredConfig& config, std::unique_ptr<const PathLoss> otherwise);

  hal::Milliwatts after(hal::Milliwatts power, const Path& path) const override;
  /// Infinite: a measured loss may be any at any distance.
  double reach(hal::Milliwatts power, hal::Milliwatts least) const override;
  bool changes_in_time() const override { return has_times_; }

 private:
  struct Row {
    double at;    ///< s
    double loss;  ///< dB
  };
  using Link = std::pair<hal::AgentId, hal::AgentId>;
  const std::vector<Row>* rows_of(const Path& path) const;
  /// dB; nullopt: silence.
  std::optional<double> loss_at(const std::vector<Row>& rows, hal::Time time) const;

  std::map<Link, std::vector<Row>> links_;  ///< Each in order of time.
  MeasuredBetween between_;
  bool has_times_;
  double silence_;  ///< s, infinite without.
  std::unique_ptr<const PathLoss> otherwise_;
};

}  // namespace sim::radio
