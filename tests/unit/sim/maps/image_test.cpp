#include "sim/maps/image.h"

#include <gtest/gtest.h>
#include <png.h>

#include <stdexcept>

#include "tests/unit/sim/maps/map_files.h"

namespace sim::maps::test {
namespace {

/// An image as one list of channels: red, green, blue, alpha of each pixel.
struct Read {
  ImageSize size;
  std::vector<unsigned> channels;
};

Read read(const std::filesystem::path& file) {
  Read result;
  std::size_t next = 0;
  read_image(file,
             {[&](const ImageSize& size) { result.size = size; },
              [&](std::size_t row, std::span<const Pixel> pixels) {
                EXPECT_EQ(row, next++);
                EXPECT_EQ(pixels.size(), result.size.width);
                for (const Pixel& p : pixels)
                  result.channels.insert(result.channels.end(), {p.red, p.green, p.blue, p.alpha});
              }});
  EXPECT_EQ(next, result.size.height);
  return result;
}

/// Red channels alone.
std::vector<unsigned> reds(const Read& image) {
  std::vector<unsigned> result;
  for (std::size_t i = 0; i < image.channels.size(); i += 4) result.push_back(image.channels[i]);
  return result;
}

std::string message(const std::filesystem::path& file) {
  try {
    read(file);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "";
}

struct PngForm {
  int bits = 8, colours = PNG_COLOR_TYPE_GRAY, interlace = PNG_INTERLACE_NONE;
};

/// Writes rows of samples as libpng takes them.
std::filesystem::path write_png(const Folder& folder, const PngForm& form, unsigned width,
                                const std::vector<std::string>& rows,
                                const std::vector<png_color>& palette = {},
                                const std::vector<png_byte>& opacities = {}) {
  const std::filesystem::path path = folder.path() / "written.png";
  std::FILE* file = std::fopen(path.c_str(), "wb");
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file);
  png_set_IHDR(png, info, width, static_cast<png_uint_32>(rows.size()), form.bits, form.colours,
               form.interlace, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (!palette.empty()) png_set_PLTE(png, info, palette.data(), static_cast<int>(palette.size()));
  if (!opacities.empty())
    png_set_tRNS(png, info, opacities.data(), static_cast<int>(opacities.size()), nullptr);
  png_write_info(png, info);
  std::vector<png_bytep> pointers;
  for (const std::string& row : rows)
    pointers.push_back(
        reinterpret_cast<png_bytep>(const_cast<char*>(row.data())));  // NOLINT: libpng's type
  png_write_image(png, pointers.data());
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  std::fclose(file);
  return path;
}

using List = std::vector<unsigned>;

TEST(Pgm, PlainAndBinaryFilesHoldTheSameImage) {
  const Folder folder;
  const Read plain =
      read(folder.write("a.pgm", "P2\n# by hand\n3 2\n255\n0 128 255\n1 2 # !\n3\n"));
  const Read binary = read(folder.write("b.pgm", std::string("P5 3 2 255\n\0\x80\xff\1\2\3", 17)));
  EXPECT_EQ(plain.size.width, 3U);
  EXPECT_EQ(plain.size.height, 2U);
  EXPECT_FALSE(plain.size.has_alpha);
  EXPECT_EQ(reds(plain), (List{0, 128 * 257, 65535, 257, 514, 771}));
  EXPECT_EQ(plain.channels, binary.channels);
}

TEST(Pgm, LevelsAreScaledByTheMaximumValue) {
  const Folder folder;
  EXPECT_EQ(reds(read(folder.write("a.pgm", "P2 4 1 3 0 1 2 3"))), (List{0, 21845, 43690, 65535}));
  // 16 bits, the high byte first
  EXPECT_EQ(reds(read(folder.write("b.pgm", std::string("P5 2 1 65535\n\x01\x02\xff\xff", 17)))),
            (List{0x0102, 65535}));
  EXPECT_EQ(reds(read(folder.write("c.pgm", std::string("P5 2 1 1000\n\x01\xf4\x03\xe8", 16)))),
            (List{32768, 65535}));  // 500 / 1000 of 65535 = 32767.5, rounded up
}

TEST(Pgm, CommentsMayStandBetweenTheNumbersOfTheHead) {
  const Folder folder;
  EXPECT_EQ(reds(read(folder.write(
                "a.pgm", "P5\n# CREATOR: map_saver 0.050 m/pix\n2#two\n1\n# maximum\n255\nAB"))),
            (List{'A' * 257, 'B' * 257}));
}

TEST(Pgm, SaysWhatIsBroken) {
  const Folder folder;
  EXPECT_EQ(message(folder.write("a.pgm", "P5 3 2 255\nabcd")), "ends in row 2");
  EXPECT_EQ(message(folder.write("b.pgm", "P2 2 1 7 5 8")),
            "row 1: a level of 8, above the maximum of 7");
  EXPECT_EQ(message(folder.write("c.pgm", "P2 2 2 7 5 6 7")), "row 2: the file ends there");
  EXPECT_EQ(message(folder.write("k.pgm", "P2 2 2 7 5 x")), "row 1: not a number");
  EXPECT_EQ(message(folder.write("d.pgm", "P5 0 2 255\n")), "has no pixels");
  EXPECT_EQ(message(folder.write("e.pgm", "P5 99999 99999 255\n")),
            "has 99999 x 99999 pixels, at most 268435456 allowed");
  EXPECT_EQ(message(folder.write("f.pgm", "P5 2 2 65536\n")),
            "maximum value: above the limit of 65535");
  EXPECT_EQ(message(folder.write("g.pgm", "P5 2 2 0\n")), "maximum value: must be at least 1");
  EXPECT_EQ(message(folder.write("h.pgm", "P5 two")), "width: not a number");
  EXPECT_EQ(message(folder.write("i.pgm", "P6 1 1 255\nabc")), "is neither PGM (P2, P5) nor PNG");
  EXPECT_EQ(message(folder.write("j.pgm", "")), "cannot be read, or is empty");
}

TEST(Png, GreyOfEveryDepth) {
  const Folder folder;
  EXPECT_EQ(reds(read(write_png(folder, {.bits = 1}, 4, {"\x50"}))), (List{0, 65535, 0, 65535}));
  EXPECT_EQ(reds(read(write_png(folder, {.bits = 2}, 4, {"\x1b"}))),
            (List{0, 21845, 43690, 65535}));
  EXPECT_EQ(reds(read(write_png(folder, {.bits = 4}, 2, {"\x1f"}))), (List{0x1111, 65535}));
  EXPECT_EQ(reds(read(write_png(folder, {.bits = 8}, 2, {"\x01\xcd"}))), (List{257, 205 * 257}));
  EXPECT_EQ(reds(read(write_png(folder, {.bits = 16}, 1, {"\x12\x34"}))), (List{0x1234}));
}

TEST(Png, ColoursAndAlpha) {
  const Folder folder;
  const Read rgb = read(write_png(folder, {.colours = PNG_COLOR_TYPE_RGB}, 1, {"\x01\x02\x03"}));
  EXPECT_EQ(rgb.channels, (List{257, 514, 771, 65535}));
  EXPECT_FALSE(rgb.size.has_alpha);
  const Read rgba =
      read(write_png(folder, {.colours = PNG_COLOR_TYPE_RGB_ALPHA}, 1, {"\x01\x02\x03\x80"}));
  EXPECT_EQ(rgba.channels, (List{257, 514, 771, 128 * 257}));
  EXPECT_TRUE(rgba.size.has_alpha);
  const Read grey =
      read(write_png(folder, {.colours = PNG_COLOR_TYPE_GRAY_ALPHA}, 1, {"\x05\xff"}));
  EXPECT_EQ(grey.channels, (List{1285, 1285, 1285, 65535}));
  EXPECT_TRUE(grey.size.has_alpha);
}

TEST(Png, APaletteHasItsColoursAndOpacities) {
  const Folder folder;
  const std::vector<png_color> palette{{1, 2, 3}, {255, 255, 255}};
  const Read plain =
      read(write_png(folder, {.bits = 1, .colours = PNG_COLOR_TYPE_PALETTE}, 2, {"\x40"}, palette));
  EXPECT_EQ(plain.channels, (List{257, 514, 771, 65535, 65535, 65535, 65535, 65535}));
  EXPECT_FALSE(plain.size.has_alpha);
  const Read clear = read(write_png(folder, {.bits = 1, .colours = PNG_COLOR_TYPE_PALETTE}, 2,
                                    {"\x40"}, palette, {0, 128}));
  EXPECT_EQ(clear.channels, (List{257, 514, 771, 0, 65535, 65535, 65535, 128 * 257}));
  EXPECT_TRUE(clear.size.has_alpha);
}

TEST(Png, AnInterlacedFileHoldsTheSameImage) {
  const Folder folder;
  std::vector<std::string> rows;
  for (char y = 0; y < 11; ++y) {
    rows.emplace_back();
    for (char x = 0; x < 13; ++x) rows.back() += static_cast<char>(17 * y + x);
  }
  const Read plain = read(write_png(folder, {}, 13, rows));
  const Read interlaced = read(write_png(folder, {.interlace = PNG_INTERLACE_ADAM7}, 13, rows));
  EXPECT_EQ(plain.channels, interlaced.channels);
  EXPECT_EQ(reds(plain)[13 * 10 + 12], 257U * (17 * 10 + 12));
}

TEST(Png, SaysThatItIsBrokenWhereverItEnds) {
  const Folder folder;
  const auto whole = write_png(folder, {}, 40, std::vector<std::string>(30, std::string(40, 'x')));
  const auto size = std::filesystem::file_size(whole);
  std::string content(size, '\0');
  std::ifstream(whole, std::ios::binary).read(content.data(), static_cast<std::streamsize>(size));
  for (std::size_t length = 4; length < size; ++length) {
    EXPECT_TRUE(
        message(folder.write("cut.png", content.substr(0, length))).starts_with("is broken: "))
        << length;
  }
  content[45] = static_cast<char>(content[45] ^ 1);  // in the pixels
  EXPECT_TRUE(message(folder.write("changed.png", content)).starts_with("is broken: "));
}

}  // namespace
}  // namespace sim::maps::test
