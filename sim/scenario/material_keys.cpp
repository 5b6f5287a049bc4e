#include "sim/scenario/material_keys.h"

#include <fmt/format.h>

#include <algorithm>

namespace sim::scenario {
namespace {

constexpr Range kMaterialLoss{0, 1000};  // dB

void keys_of(Fields& io, Material& material) {
  io.needed_text({"name", "Name of the material, for `material`.", "fire_door"}, material.name);
  io.needed({"loss", "Loss of one crossing of a wall of it, in the 2.4 GHz band.", "12 dB"}, "dB",
            kMaterialLoss, material.loss.value);
  const bool is_apart = io.reading() == nullptr || io.reading()->has("loss_5ghz");
  if (!is_apart) material.loss_5ghz = material.loss;
  io.quantity({"loss_5ghz", "The same in the 5 GHz band.", "14 dB", "`loss`"}, "dB", kMaterialLoss,
              material.loss_5ghz);
}

void refuse_repeated(Fields& io, const std::vector<Material>& own) {
  std::vector<Mapping> items = io.reading()->items("materials");
  for (std::size_t i = 0; i < std::min(items.size(), own.size()); ++i) {
    const auto before = own.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::ranges::find(own.begin(), before, own[i].name, &Material::name) != before)
      items[i].mistake("name", fmt::format("'{}' is defined twice", own[i].name));
  }
}

}  // namespace

void materials_key(Fields& io, std::vector<Material>& own) {
  io.list_if_any<Material>(
      {"materials",
       "Materials of walls, beside the built-in ones (" + names_of_materials({}) +
           "); one with the name of a built-in one replaces it.",
       "[{name: fire_door, loss: 12 dB}]"},
      own, [](Fields& one, Material& material) { keys_of(one, material); });
  if (io.reading() != nullptr) refuse_repeated(io, own);
}

void material_key(Fields& io, std::span<const Material> own, std::string& name) {
  io.text({"material",
           "What it is made of, for the propagation model `multi_wall`: one of `materials`, or " +
               names_of_materials({}) + ".",
           "concrete"},
          name);
  if (find_material(name, own)) return;
  io.mistake("material", fmt::format("unknown material '{}': must be one of {}", name,
                                     names_of_materials(own)));
}

}  // namespace sim::scenario
