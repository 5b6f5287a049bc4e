#pragma once

#include <span>
#include <string>
#include <vector>

#include "results/coverage/coverage.h"
#include "results/coverage/coverage_classes.h"
#include "sim/physics/world.h"

namespace results::coverage {

/// One layer as a self-contained drawing seen from above: Scalable Vector Graphics 1.1 with axes in
/// m, the walls, the transmitters and a legend. Colour is the class of the value; grey: below the
/// sensitivity.
std::string coverage_svg(const Coverage& map, Layer layer,
                         std::span<const sim::physics::StaticBox> walls);

/// All layers as one self-contained page of HTML, with the share of the floor in each class.
std::string coverage_page(const Coverage& map, const std::string& title,
                          std::span<const sim::physics::StaticBox> walls);

/// Share of the floor by rate and by transmitter, as text.
std::string coverage_text(const Coverage& map);

}  // namespace results::coverage
