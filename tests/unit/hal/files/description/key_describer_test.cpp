#include "hal/files/description/key_describer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <variant>
#include <vector>

namespace hal::files::description {
namespace {

using config::Condition;
using config::KeyDescription;
using Lines = std::vector<std::string>;

struct Ball {
  double radius = 3;  // m
};
struct Box {
  double friction = 0.5;
};
struct Point {};
using Shape = std::variant<Ball, Box, Point>;

double friction_of(const Shape& shape) { return std::holds_alternative<Ball>(shape) ? 0.1 : 0.5; }

const std::array<Fields::Kind<Shape>, 3> kShapes{{{"ball", []() -> Shape { return Ball{}; }},
                                                  {"box", []() -> Shape { return Box{}; }},
                                                  {"point", []() -> Shape { return Point{}; }}}};

using Way = std::variant<std::monostate, Ball, Box>;
const std::array kWays{alternative<Way, Ball>({"round", "Along it."}),
                       alternative<Way, Box>({"straight", "Along it."})};

void way_keys(Fields& io, Way& way) {
  if (auto* ball = std::get_if<Ball>(&way))
    io.number({"radius", "Of it.", "1 m"}, "m", {0, 9}, ball->radius);
}

void shape_keys(Fields& io, Shape& shape) {
  double friction = friction_of(shape);
  io.number({"friction", "Of the surface.", "0.1"}, "1", {0, 1}, friction);
  if (auto* ball = std::get_if<Ball>(&shape))
    io.number({"radius", "Of the ball.", "1 m"}, "m", {0, kUnlimited}, ball->radius);
  if (std::holds_alternative<Box>(shape)) {
    io.inside({"box", "The box."}, [](Fields& box) {
      Vec3 size;
      box.needed({"size", "Its.", "[1 m, 1 m, 1 m]"}, "m", {0, 9}, size);
    });
  }
}

/// Keys that stand only with other keys' values, and defaults that depend on them.
std::vector<KeyDescription> described() {
  KeyDescriber io;
  double mass = 0;
  io.needed({"mass", "Of all.", "2 kg"}, "kg", {0, 10}, mass);
  Shape shape;
  io.kinds({"shape", "Which one.", "ball"}, kShapes, shape, shape_keys);
  std::string label;
  io.given_text({"label", "Of the thing.", "a"}, label);
  std::vector<Vec2> places;
  io.list<Vec2>({"places", "Where.", "[{x: 1 m}]"}, places, [](Fields& one, Vec2& at) {
    one.needed({"x", "Where.", "1 m"}, "m", {0, 1}, at.x);
  });
  bool is_on = false;
  io.flag({"on", "Or off.", "true"}, is_on);
  io.only(is_on, {"on", {"true"}}, "needs `on: true`", [](Fields& on) {
    Duration period{};
    on.duration({"period", "Of it.", "1 s", "as before"}, {0, 9}, period);
  });
  Way way;
  io.inside({"way", "Where it goes."}, [&](Fields& inside) {
    inside.one_of(kWays, way, way_keys, [](Fields& none) {
      Vec2 to;
      none.vec2({"to", "Its end.", "[1 m, 2 m]"}, "m", {0, 9}, to);
    });
  });
  return io.keys();
}

const KeyDescription& of(const std::vector<KeyDescription>& keys, const std::string& path) {
  const auto found = std::ranges::find(keys, path, &KeyDescription::path);
  if (found != keys.end()) return *found;
  static const KeyDescription none;
  ADD_FAILURE() << "no description of " << path;
  return none;
}

TEST(KeyDescriber, TellsOfEveryKeyThoseOfAMappingTogether) {
  Lines paths;
  for (const KeyDescription& key : described()) paths.push_back(key.path);
  EXPECT_EQ(paths, (Lines{"mass", "shape", "friction", "radius", "box", "label", "places", "on",
                          "period", "way", "box.size", "places[].x", "way.round", "way.straight",
                          "way.to", "way.round.radius"}));
}

TEST(KeyDescriber, SaysWhatAKeyHangsOn) {
  const auto keys = described();
  EXPECT_TRUE(of(keys, "mass").conditions.empty());
  EXPECT_TRUE(of(keys, "friction").conditions.empty()) << "every shape has it";
  ASSERT_EQ(of(keys, "box").conditions.size(), 1U);
  EXPECT_EQ(of(keys, "box").conditions[0].path, "shape");
  EXPECT_EQ(of(keys, "box").conditions[0].values, Lines{"box"});
  EXPECT_TRUE(of(keys, "box.size").conditions.empty()) << "the box has it";
  ASSERT_EQ(of(keys, "period").conditions.size(), 1U);
  EXPECT_EQ(of(keys, "period").conditions[0].values, Lines{"true"});
  ASSERT_EQ(of(keys, "way.to").conditions.size(), 2U) << "no alternative is there";
  EXPECT_EQ(of(keys, "way.to").conditions[0].path, "way.round");
  EXPECT_TRUE(of(keys, "way.to").conditions[0].presence);
  EXPECT_EQ(of(keys, "way.to").conditions[0].values, Lines{"absent"});
}

TEST(KeyDescriber, KnowsWhatMustBeGivenAndWhatDefaultsDependOn) {
  const auto keys = described();
  EXPECT_EQ(of(keys, "mass").variants.at(0).otherwise, "");
  EXPECT_FALSE(of(keys, "mass").optional);
  EXPECT_TRUE(of(keys, "label").optional);
  EXPECT_EQ(of(keys, "period").variants.at(0).otherwise, "as before");
  const auto& variants = of(keys, "friction").variants;
  ASSERT_EQ(variants.size(), 3U);
  EXPECT_EQ(variants[0].with, "ball");
  EXPECT_EQ(variants[0].otherwise, "0.1");
  EXPECT_EQ(variants[2].with, "point");
  EXPECT_EQ(variants[2].otherwise, "0.5");
  EXPECT_EQ(of(keys, "radius").variants.at(0).limits, "0 m or more, or none");
}

}  // namespace
}  // namespace hal::files::description
