#include "hal/files/config/survey.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace hal::files::config {
namespace {

enum class Shape { kBall, kBox, kPoint };
constexpr std::array kShapes = {Option<Shape>{"ball", Shape::kBall},
                                Option<Shape>{"box", Shape::kBox},
                                Option<Shape>{"point", Shape::kPoint}};

/// Keys that stand only with other keys' values, and defaults that depend on them.
void read(Mapping in) {
  in.number({"mass", "Of all.", "2 kg"}, "kg", {0, 10});
  const Shape shape = in.choice({"shape", "Which one.", "ball"}, kShapes).value_or(Shape::kBall);
  in.number({"friction", "Of the surface.", "0.1"}, "1", {0, 1}, shape == Shape::kBall ? 0.1 : 0.5);
  if (shape == Shape::kBall) in.number({"radius", "Of the ball.", "1 m"}, "m", {0, kUnlimited}, 3);
  if (shape == Shape::kBox)
    in.mapping({"box", "The box."}).vec3({"size", "Its.", "[1 m, 1 m, 1 m]"}, "m", {0, 9});
  if (in.has("label")) in.text({"label", "Of the thing.", "a"});
  if (in.has("x")) {
    in.number({"x", "Where.", "1 m"}, "m", {0, 1});
  } else {
    in.number({"bearing", "Whither.", "1 rad"}, "rad", {0, 1});
  }
  for (Mapping& item : in.mappings({"items", "Things."}))
    item.flag({"on", "Or off.", "true"}, true);
  for (const std::string& name : in.keys()) in.mapping({name, "Named."});
}

const KeyDescription& of(const KeyTable& table, const std::string& path) {
  const auto found = std::find_if(table.keys.begin(), table.keys.end(),
                                  [&](const KeyDescription& key) { return key.path == path; });
  if (found != table.keys.end()) return *found;
  static const KeyDescription none;
  ADD_FAILURE() << "no description of " << path;
  return none;
}

std::vector<std::string> paths(const KeyTable& table) {
  std::vector<std::string> result;
  for (const KeyDescription& key : table.keys) result.push_back(key.path);
  return result;
}

TEST(SurveyTest, FindsTheKeysOfEveryWayThroughAReader) {
  EXPECT_EQ(paths(survey(read)),
            (std::vector<std::string>{"mass", "shape", "friction", "radius", "label", "x", "items",
                                      "NAME", "box", "bearing", "items[].on", "box.size"}));
}

TEST(SurveyTest, SaysUnderWhatAKeyStands) {
  const KeyTable table = survey(read);
  const auto& radius = of(table, "radius").conditions;
  ASSERT_EQ(radius.size(), 1U);
  EXPECT_EQ(radius[0].path, "shape");
  EXPECT_EQ(radius[0].values, std::vector<std::string>{"ball"});
  const auto& bearing = of(table, "bearing").conditions;
  ASSERT_EQ(bearing.size(), 1U);
  EXPECT_TRUE(bearing[0].presence);
  EXPECT_EQ(bearing[0].path, "x");
  EXPECT_EQ(bearing[0].values, std::vector<std::string>{"absent"});
  EXPECT_TRUE(of(table, "mass").conditions.empty());
  EXPECT_TRUE(of(table, "x").conditions.empty());
  EXPECT_TRUE(of(table, "box.size").conditions.empty()) << "what holds for the box is said there";
}

TEST(SurveyTest, KnowsWhatMustBeGivenAndWhatDefaultsDependOn) {
  const KeyTable table = survey(read);
  EXPECT_EQ(of(table, "mass").variants.at(0).otherwise, "");
  EXPECT_FALSE(of(table, "mass").optional);
  EXPECT_EQ(of(table, "radius").variants.at(0).otherwise, "3 m");
  EXPECT_TRUE(of(table, "label").optional);
  const auto& friction = of(table, "friction").variants;
  ASSERT_EQ(friction.size(), 3U);
  EXPECT_EQ(friction[0].with + " " + friction[0].otherwise, "ball 0.1");
  EXPECT_EQ(friction[2].with + " " + friction[2].otherwise, "point 0.5");
}

TEST(SurveyTest, NoticesAKeyThatIsLookedForButNeverRead) {
  const KeyTable table = survey([](Mapping in) {
    if (in.has("forgotten")) in.mistake("forgotten", "is wrong");
  });
  EXPECT_EQ(table.never_read, std::vector<std::string>{"forgotten"});
}

TEST(SurveyTest, FindsKeysThatTwoDecisionsTogetherAllow) {
  const KeyTable table = survey([](Mapping in) {
    const Shape one = in.choice({"one", "A.", "box"}, kShapes).value_or(Shape::kBall);
    const Shape two = in.choice({"two", "B.", "box"}, kShapes).value_or(Shape::kBall);
    if (one == Shape::kBox && two == Shape::kBox) in.flag({"both", "C.", "true"}, false);
  });
  EXPECT_EQ(of(table, "both").conditions.size(), 2U);
}

TEST(SurveyTest, SeesWhatAChoiceInOneMappingDecidesInAnother) {
  const KeyTable table = survey([](Mapping in) {
    Mapping radio = in.mapping({"radio", "One mapping."});
    const Shape shape = radio.choice({"shape", "Which.", "ball"}, kShapes, Shape::kBall);
    Mapping agent = in.mapping({"agent", "Another one."});
    agent.integer({"size", "Its default too.", "1"}, 0, 9, shape == Shape::kBall ? 1 : 2);
    if (shape != Shape::kPoint) agent.flag({"round", "Or flat.", "true"}, false);
    if (agent.has("label") && shape == Shape::kBox) agent.text({"label", "Of it.", "a"});
  });
  EXPECT_EQ(of(table, "agent.size").variants.size(), 3U);
  const auto& round = of(table, "agent.round").conditions;
  ASSERT_EQ(round.size(), 1U);
  EXPECT_EQ(round[0].path, "radio.shape");
  EXPECT_EQ(round[0].values, (std::vector<std::string>{"ball", "box"}));
  const auto& label = of(table, "agent.label").conditions;
  ASSERT_EQ(label.size(), 1U);
  EXPECT_EQ(label[0].path, "radio.shape");
  EXPECT_EQ(label[0].values, std::vector<std::string>{"box"});
}

TEST(FormTest, SaysWhatAKeyThatIsMissingWants) {
  EXPECT_EQ(missing({"size", "Of it.", "[1 m, 2 m, 3 m]"},
                    {.kind = Form::Kind::kVector, .unit = "m", .range = {0.5, 9}, .size = 3}),
            "is missing: [x, y, z], each a number with its unit (m), 0.5 m .. 9 m, e.g. [1 m, 2 m, "
            "3 m]");
  EXPECT_EQ(missing({"n", "Of it."}, {.kind = Form::Kind::kWhole, .low = 1, .high = 9}),
            "is missing: a whole number, 1 .. 9");
  EXPECT_EQ(limits({.kind = Form::Kind::kNumber, .unit = "s", .range = {0, kUnlimited}}),
            "0 s or more, or never");
}

}  // namespace
}  // namespace hal::files::config
