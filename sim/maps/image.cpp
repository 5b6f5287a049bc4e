#include "sim/maps/image.h"

#include <array>
#include <fstream>
#include <stdexcept>
#include <string_view>

#include "sim/maps/formats.h"

namespace sim::maps {

void read_image(const std::filesystem::path& file, const ImageUser& user) {
  std::ifstream in(file, std::ios::binary);
  std::array<char, 4> first{};
  in.read(first.data(), first.size());
  if (in.gcount() == 0) throw std::runtime_error("cannot be read, or is empty");
  const std::string_view magic(first.data(), static_cast<std::size_t>(in.gcount()));
  if (magic == "\x89PNG") return read_png(file, user);
  if (!magic.starts_with("P2") && !magic.starts_with("P5"))
    throw std::runtime_error("is neither PGM (P2, P5) nor PNG");
  in.clear();
  in.seekg(0);
  read_pgm(in, user);
}

}  // namespace sim::maps
