#pragma once

#include <span>
#include <string>
#include <vector>

#include "sim/core/material.h"
#include "sim/scenario/fields.h"

namespace sim::scenario {

/// `materials:` of `world:`, those of the scenario itself.
void materials_key(Fields& io, std::vector<Material>& own);

/// `material:` of a wall, a box or a map. @param own  those of the scenario.
void material_key(Fields& io, std::span<const Material> own, std::string& name);

}  // namespace sim::scenario
