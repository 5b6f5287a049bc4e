#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "hal/types/quantity.h"

namespace sim {

/// What a wall is made of, for radio waves: the loss of one crossing, whatever the length inside.
struct Material {
  std::string name;
  hal::Decibels loss{};       ///< In the 2.4 GHz band, >= 0.
  hal::Decibels loss_5ghz{};  ///< In the 5 GHz band, >= 0.

  bool operator==(const Material&) const = default;
};

/// Of a wall of which nothing else is said.
inline constexpr std::string_view kDefaultMaterial = "brick";

/// The materials that need no definition.
///
/// light_wall, heavy_wall: means over many buildings, measured at 1.8 GHz and used in both bands:
/// COST Action 231, "Digital mobile radio towards future generation systems", final report, 1999,
/// section 4.7, multi-wall model: plasterboard, particle board or thin light concrete (below 10
/// cm); load-bearing and other thick walls of concrete or brick.
///
/// The others: transmission through one slab at normal incidence by Recommendation ITU-R P.2040-3
/// (08/2023), equations 43b and 44, at 2.4 and 5.5 GHz, with the permittivity and conductivity of
/// its table 3, for brick of 12 cm, concrete of 15 cm, plasterboard of 25 mm, wood of 4 cm and
/// glass of 6 mm.
std::span<const Material> built_in_materials();

/// The material of that name: of `own`, else built in; nullopt: there is none.
std::optional<Material> find_material(std::string_view name, std::span<const Material> own);

/// "light_wall, heavy_wall, …": own names first.
std::string names_of_materials(std::span<const Material> own);

}  // namespace sim
