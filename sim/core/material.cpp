#include "sim/core/material.h"

#include <algorithm>
#include <array>

namespace sim {
namespace {

const Material* find_in(std::span<const Material> all, std::string_view name) {
  const auto found = std::ranges::find(all, name, &Material::name);
  return found == all.end() ? nullptr : &*found;
}

Material material(std::string_view name, double loss, double loss_5ghz) {
  return {std::string(name), hal::Decibels{loss}, hal::Decibels{loss_5ghz}};
}

}  // namespace

std::span<const Material> built_in_materials() {
  static const std::array all{material("light_wall", 3.4, 3.4), material("heavy_wall", 6.9, 6.9),
                              material("brick", 3.5, 4.2),      material("concrete", 11.4, 20.2),
                              material("wood", 0.6, 1.5),       material("plasterboard", 1.2, 2.0),
                              material("glass", 1.9, 3.3)};
  return all;
}

std::optional<Material> find_material(std::string_view name, std::span<const Material> own) {
  const Material* found = find_in(own, name);
  if (found == nullptr) found = find_in(built_in_materials(), name);
  return found == nullptr ? std::nullopt : std::optional(*found);
}

std::string names_of_materials(std::span<const Material> own) {
  std::string names;
  const auto add = [&names](const Material& one) {
    if (!names.empty()) names += ", ";
    names += one.name;
  };
  std::ranges::for_each(own, add);
  std::ranges::for_each(built_in_materials(), add);
  return names;
}

}  // namespace sim
