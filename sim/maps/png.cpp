#include <png.h>

#include <csetjmp>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/maps/formats.h"

namespace sim::maps {
namespace {

constexpr png_uint_32 kChannels = 4;

void on_warning(png_structp /*png*/, png_const_charp /*text*/) {}

/// libpng reports an error by a jump past the frames of its callers, so that those of ours own
/// nothing: each call of it is in one of the functions with `setjmp`, and what they fill is here.
struct Reading {
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::string error;
  ImageSize size;
  bool is_wide = false;        ///< 16 bits.
  bool is_interlaced = false;  ///< All rows are read before the first is known.

  explicit Reading(std::FILE* file) {
    png = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning);
    if (png == nullptr) throw std::bad_alloc();
    info = png_create_info_struct(png);
    if (info == nullptr) throw std::bad_alloc();
    png_init_io(png, file);
  }
  ~Reading() { png_destroy_read_struct(&png, &info, nullptr); }
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;

  [[noreturn]] static void on_error(png_structp png, png_const_charp text) {
    static_cast<Reading*>(png_get_error_ptr(png))->error = text;
    png_longjmp(png, 1);
  }
  [[noreturn]] void fail() const { throw std::runtime_error("is broken: " + error); }
};

bool read_head(Reading& reading) {
  if (setjmp(png_jmpbuf(reading.png)) != 0) return false;
  png_set_user_limits(reading.png, 1U << 30U, 1U << 30U);  // check_size() has ours
  png_read_info(reading.png, reading.info);
  const png_byte colours = png_get_color_type(reading.png, reading.info);
  const bool has_key = png_get_valid(reading.png, reading.info, PNG_INFO_tRNS) != 0;
  reading.size = {png_get_image_width(reading.png, reading.info),
                  png_get_image_height(reading.png, reading.info),
                  has_key || (colours & PNG_COLOR_MASK_ALPHA) != 0};
  reading.is_wide = png_get_bit_depth(reading.png, reading.info) == 16;
  reading.is_interlaced = png_get_interlace_type(reading.png, reading.info) != PNG_INTERLACE_NONE;
  return true;
}

/// Every format becomes RGBA.
bool set_output(Reading& reading) {
  if (setjmp(png_jmpbuf(reading.png)) != 0) return false;
  png_set_expand(reading.png);
  png_set_gray_to_rgb(reading.png);
  png_set_add_alpha(reading.png, 0xFFFF, PNG_FILLER_AFTER);
  png_set_interlace_handling(reading.png);
  png_read_update_info(reading.png, reading.info);
  return true;
}

bool read_rows(Reading& reading, png_bytepp rows, png_uint_32 count) {
  if (setjmp(png_jmpbuf(reading.png)) != 0) return false;
  if (reading.is_interlaced)
    png_read_image(reading.png, rows);
  else
    png_read_rows(reading.png, rows, nullptr, count);
  return true;
}

bool read_end(Reading& reading) {
  if (setjmp(png_jmpbuf(reading.png)) != 0) return false;
  png_read_end(reading.png, nullptr);
  return true;
}

void convert(const png_byte* bytes, bool is_wide, std::vector<Pixel>& pixels) {
  const auto level = [&](std::size_t i) {
    return is_wide ? static_cast<std::uint16_t>(256 * bytes[2 * i] + bytes[2 * i + 1])
                   : static_cast<std::uint16_t>(257 * bytes[i]);
  };
  for (std::size_t i = 0; i < pixels.size(); ++i)
    pixels[i] = {level(kChannels * i), level(kChannels * i + 1), level(kChannels * i + 2),
                 level(kChannels * i + 3)};
}

void hand_out(Reading& reading, const ImageUser& user) {
  const std::size_t row_bytes = png_get_rowbytes(reading.png, reading.info);
  const std::size_t buffered = reading.is_interlaced ? reading.size.height : 1;
  std::vector<png_byte> bytes(row_bytes * buffered);
  std::vector<png_bytep> rows(buffered);
  for (std::size_t i = 0; i < buffered; ++i) rows[i] = bytes.data() + i * row_bytes;
  std::vector<Pixel> pixels(reading.size.width);
  for (std::size_t row = 0; row < reading.size.height; ++row) {
    const bool is_new = !reading.is_interlaced || row == 0;
    if (is_new && !read_rows(reading, rows.data(), 1)) reading.fail();
    convert(rows[row % buffered], reading.is_wide, pixels);
    user.row(row, pixels);
  }
}

}  // namespace

void read_png(const std::filesystem::path& file, const ImageUser& user) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rb"),
                                                               &std::fclose);
  if (stream == nullptr) throw std::runtime_error("cannot be read");
  Reading reading(stream.get());
  if (!read_head(reading)) reading.fail();
  check_size(reading.size);
  if (!set_output(reading)) reading.fail();
  user.begin(reading.size);
  hand_out(reading, user);
  if (!read_end(reading)) reading.fail();
}

}  // namespace sim::maps
