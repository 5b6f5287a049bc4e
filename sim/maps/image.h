#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>

namespace sim::maps {

/// One pixel; each channel 0 .. 65535, with 65535 in `alpha` for an opaque pixel.
struct Pixel {
  std::uint16_t red = 0, green = 0, blue = 0, alpha = 65535;
};

struct ImageSize {
  std::size_t width = 0, height = 0;  ///< Pixels, each > 0.
  bool has_alpha = false;             ///< The file has an alpha channel or a transparent colour.
};

inline constexpr std::size_t kMostPixels = std::size_t{1} << 28U;

/// Receives an image: `begin` once, then each row once, the uppermost first.
struct ImageUser {
  std::function<void(const ImageSize& size)> begin;
  std::function<void(std::size_t row, std::span<const Pixel> pixels)> row;
};

/// Reads a PGM file (P2 or P5, maximum value up to 65535) or a PNG file (grey, grey with alpha,
/// palette, RGB, RGBA; 1 to 16 bits; interlaced or not). Levels are scaled to 16 bits.
/// @throws std::runtime_error  what is wrong with the file, without its name; at most kMostPixels.
void read_image(const std::filesystem::path& file, const ImageUser& user);

}  // namespace sim::maps
