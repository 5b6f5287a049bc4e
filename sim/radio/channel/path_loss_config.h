#pragma once

#include <string_view>
#include <type_traits>
#include <variant>

#include "sim/radio/channel/foreign_law.h"
#include "sim/radio/channel/friis.h"
#include "sim/radio/channel/log_distance.h"
#include "sim/radio/channel/measured.h"
#include "sim/radio/channel/multi_wall.h"
#include "sim/radio/channel/nakagami.h"
#include "sim/radio/channel/path_loss.h"
#include "sim/radio/channel/power_law.h"
#include "sim/radio/channel/rayleigh.h"
#include "sim/radio/channel/rician.h"
#include "sim/radio/channel/shadowing.h"
#include "sim/radio/channel/two_ray_ground.h"
#include "sim/radio/channel/two_ray_interference.h"

namespace sim::radio {

/// One entry of a chain of propagation: the list of all laws, by what their headers have.
///
///   struct FriisConfig                     its settings, with its kModel and kKind
///   keys_of(Fields& io, FriisConfig& c)    its keys, as hal/files/description/fields.h has them;
///                                          a template, for this folder does not see that file
///   make(const FriisConfig&, air, ground)  its PathLoss
///
/// Files can name all but the last one, by kModel.
using PathLossConfig =
    std::variant<PowerLawConfig, FriisConfig, LogDistanceConfig, MultiWallConfig,
                 TwoRayGroundConfig, TwoRayInterferenceConfig, MeasuredConfig, ShadowingConfig,
                 NakagamiConfig, RicianConfig, RayleighConfig, ForeignLawConfig>;

/// Number of those that files can name.
inline constexpr std::size_t kNamedLaws = std::variant_size_v<PathLossConfig> - 1;
static_assert(
    std::is_same_v<std::variant_alternative_t<kNamedLaws, PathLossConfig>, ForeignLawConfig>);

inline PathLossKind kind_of(const PathLossConfig& config) {
  return std::visit(
      [](const auto& one) {
        if constexpr (requires { one.kind; })
          return one.kind;
        else
          return one.kKind;
      },
      config);
}

/// Its name, as in files.
inline std::string_view model_of(const PathLossConfig& config) {
  return std::visit(
      [](const auto& one) {
        if constexpr (requires { one.model; })
          return one.model;
        else
          return one.kModel;
      },
      config);
}

inline bool is_law_of_distance(const PathLossConfig& config) {
  return kind_of(config) == PathLossKind::kLawOfDistance;
}
inline bool is_fading(const PathLossConfig& config) {
  return kind_of(config) == PathLossKind::kFading;
}

}  // namespace sim::radio
