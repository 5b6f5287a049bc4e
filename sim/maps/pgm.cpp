#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "sim/maps/formats.h"

namespace sim::maps {
namespace {

constexpr std::uint32_t kHighest = 65535;

bool is_space(int c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
bool is_digit(int c) { return c >= '0' && c <= '9'; }

/// Next character after white space and comments, which go from # to the end of the line.
int next_word(std::istream& in) {
  int c = in.get();
  while (is_space(c) || c == '#') {
    if (c == '#')
      while (c != '\n' && c != '\r' && c != EOF) c = in.get();
    else
      c = in.get();
  }
  return c;
}

/// A decimal number. The character after it is read, too. @param what  for the message
std::uint32_t number(std::istream& in, const char* what, std::uint32_t highest) {
  int c = next_word(in);
  if (c == EOF) throw std::runtime_error(fmt::format("{}: the file ends there", what));
  if (!is_digit(c)) throw std::runtime_error(fmt::format("{}: not a number", what));
  std::uint64_t value = 0;
  for (; is_digit(c); c = in.get()) {
    value = 10 * value + static_cast<std::uint64_t>(c - '0');
    if (value > highest)
      throw std::runtime_error(fmt::format("{}: above the limit of {}", what, highest));
  }
  if (c == '#') in.unget();
  return static_cast<std::uint32_t>(value);
}

class PgmRows {
 public:
  PgmRows(std::istream& in, bool is_plain, std::uint32_t most)
      : in_(in), is_plain_(is_plain), most_(most) {
    for (std::uint32_t level = 0; level <= most; ++level)
      scale_.push_back(static_cast<std::uint16_t>((level * kHighest + most / 2) / most));
  }

  void read(std::size_t row, std::vector<Pixel>& pixels) {
    if (!is_plain_) fill(row, pixels.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const std::uint32_t given = is_plain_ ? plain(row) : binary(i);
      if (given > most_)
        throw std::runtime_error(
            fmt::format("row {}: a level of {}, above the maximum of {}", row + 1, given, most_));
      const std::uint16_t level = scale_[given];
      pixels[i] = {level, level, level};
    }
  }

 private:
  std::uint32_t plain(std::size_t row) const {
    return number(in_, fmt::format("row {}", row + 1).c_str(), kHighest);
  }
  std::uint32_t binary(std::size_t i) const {
    if (most_ < 256) return bytes_[i];
    return 256U * bytes_[2 * i] + bytes_[2 * i + 1];
  }
  void fill(std::size_t row, std::size_t width) {
    bytes_.resize(most_ < 256 ? width : 2 * width);
    in_.read(reinterpret_cast<char*>(bytes_.data()), static_cast<std::streamsize>(bytes_.size()));
    if (static_cast<std::size_t>(in_.gcount()) != bytes_.size())
      throw std::runtime_error(fmt::format("ends in row {}", row + 1));
  }

  std::istream& in_;
  bool is_plain_;
  std::uint32_t most_;
  std::vector<std::uint16_t> scale_;
  std::vector<unsigned char> bytes_;  ///< Of one row.
};

}  // namespace

void check_size(const ImageSize& size) {
  if (size.width == 0 || size.height == 0) throw std::runtime_error("has no pixels");
  if (size.width > kMostPixels / size.height) {
    throw std::runtime_error(fmt::format("has {} x {} pixels, at most {} allowed", size.width,
                                         size.height, kMostPixels));
  }
}

void read_pgm(std::istream& in, const ImageUser& user) {
  in.get();
  const bool is_plain = in.get() == '2';
  constexpr std::uint32_t kLongest = 1U << 30U;
  ImageSize size;
  size.width = number(in, "width", kLongest);
  size.height = number(in, "height", kLongest);
  check_size(size);
  const std::uint32_t most = number(in, "maximum value", kHighest);
  if (most == 0) throw std::runtime_error("maximum value: must be at least 1");
  user.begin(size);
  PgmRows rows(in, is_plain, most);
  std::vector<Pixel> pixels(size.width);
  for (std::size_t row = 0; row < size.height; ++row) {
    rows.read(row, pixels);
    user.row(row, pixels);
  }
}

}  // namespace sim::maps
