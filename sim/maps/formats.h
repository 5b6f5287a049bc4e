#pragma once

#include <filesystem>
#include <istream>

#include "sim/maps/image.h"

namespace sim::maps {

/// The formats of read_image(). @throws std::runtime_error
void read_pgm(std::istream& in, const ImageUser& user);
void read_png(const std::filesystem::path& file, const ImageUser& user);

/// @throws std::runtime_error  a side is 0, or there are more than kMostPixels.
void check_size(const ImageSize& size);

}  // namespace sim::maps
