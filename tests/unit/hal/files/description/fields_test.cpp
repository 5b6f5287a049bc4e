#include "hal/files/description/field_io.h"

#include "hal/types/quantity.h"
#include "tests/unit/hal/files/config/files.h"

namespace hal::files::description {
namespace {

using namespace std::chrono_literals;

enum class Colour { kRed, kBlue };
constexpr std::array kColours{Option<Colour>{"red", Colour::kRed},
                              Option<Colour>{"blue", Colour::kBlue}};

struct Disc {
  double radius = 1;
  bool operator==(const Disc&) const = default;
};
struct Bar {
  Vec3 size{1, 1, 1};
  bool operator==(const Bar&) const = default;
};
using Shape = std::variant<std::monostate, Disc, Bar>;

/// A member of each form.
struct Thing {
  double mass = 0.1;
  Milliwatts power{2};
  std::optional<Metres> reach{};
  int teeth = 3;
  Duration period = 20ms;
  std::optional<Duration> limit = 1s;
  bool is_on = true;
  std::string name = "x";
  Vec2 at{1, 2};
  Colour colour = Colour::kRed;
  std::vector<Disc> discs{};
  Shape shape{};
  int screws = 1;
  std::optional<Metres> slack{};
  std::optional<int> bolts{};
  std::optional<Colour> trim{};
  std::optional<Duration> rest{};
  std::string note{};
  std::vector<std::string> labels{};
  char grade = 'a';
  Shape lid = Disc{};
  bool is_loud = false;
  bool operator==(const Thing&) const = default;
};

const std::array kShapes{alternative<Shape, Disc>({"disc", "Its shape."}),
                         alternative<Shape, Bar>({"bar", "Its shape."})};

void shape_keys(Fields& io, Shape& shape) {
  if (auto* disc = std::get_if<Disc>(&shape))
    io.needed({"radius", "Of it.", "1 m"}, "m", {0, 10}, disc->radius);
  if (auto* bar = std::get_if<Bar>(&shape))
    io.needed({"size", "Of it.", "[1 m, 1 m, 1 m]"}, "m", {0, 10}, bar->size);
}

const std::array<Fields::Kind<Shape>, 2> kLids{
    {{"round", []() -> Shape { return Disc{}; }}, {"long", []() -> Shape { return Bar{}; }}}};

/// What a file may leave out, and what hangs on other keys.
void more_keys(Fields& io, Thing& c) {
  io.given({"slack", "Of it.", "1 m"}, "m", {0, 10}, c.slack);
  io.given_count({"bolts", "Of it.", "4"}, 0, 10, c.bolts);
  io.given_choice({"trim", "Of it.", "red"}, kColours, c.trim);
  io.given({"rest", "Of it.", "1 s"}, {0, 10}, c.rest);
  io.given_text({"note", "Of it.", "x"}, c.note);
  io.texts({"labels", "Of it.", "[a, b]"}, c.labels);
  io.spelled(
      {"grade", "Of it.", "a"}, c.grade, [](char grade) { return std::string(1, grade); },
      [&](const std::string& text, char& grade) {
        if (text.size() != 1) return io.mistake("grade", "must be a letter");
        grade = text[0];
      });
  io.written_if(c.is_loud, [&](Fields& loud) {
    loud.flag({"is_loud", "Whether it is.", "true"}, c.is_loud);
  });
}

void keys_of(Fields& io, Thing& c) {
  io.number({"mass", "Of it.", "1 kg"}, "kg", {0, 100}, c.mass);
  io.quantity({"power", "Of it.", "1 mW"}, "mW", {0, 1e5}, c.power);
  io.optional({"reach", "Of it.", "1 m"}, "m", 0, c.reach);
  io.count({"teeth", "Of it.", "7"}, 0, 100, c.teeth);
  io.duration({"period", "Of it.", "1 s"}, {0, 10}, c.period);
  io.optional_duration({"limit", "Of it.", "1 s"}, 0, c.limit);
  io.flag({"is_on", "Whether it is.", "true"}, c.is_on);
  io.text({"name", "Of it.", "y"}, c.name);
  io.vec2({"at", "Where.", "[1 m, 2 m]"}, "m", {-10, 10}, c.at);
  io.choice({"colour", "Of it.", "red"}, kColours, c.colour);
  io.list<Disc>({"discs", "Its discs.", "[{radius: 1 m}]"}, c.discs, [](Fields& one, Disc& disc) {
    one.number({"radius", "Of it.", "1 m"}, "m", {0, 10}, disc.radius);
  });
  io.inside({"shape", "One of them."},
            [&](Fields& shape) { shape.one_of(kShapes, c.shape, shape_keys); });
  io.only(c.is_on, {"is_on", {"true"}}, "needs `is_on: true`", [&](Fields& on) {
    on.count({"screws", "Of it.", "2"}, 0, 10, c.screws);
  });
  more_keys(io, c);
}

void lid_key(Fields& io, Thing& c) {
  io.inside({"lid", "Of it."}, [&](Fields& lid) {
    lid.kinds({"kind", "Of lid.", "round"}, kLids, c.lid, shape_keys);
  });
}

class FieldsTest : public config::Files {
 protected:
  Thing read(const std::string& text) const {
    auto document = config::Document::load(write("thing.yaml", text));
    Mapping in = document.root();
    Thing thing;
    FieldReader reader(in);
    keys_of(reader, thing);
    in.finish();
    document.finish();
    return thing;
  }
  static std::string written(Thing thing) {
    Writer out;
    FieldWriter writer(out);
    keys_of(writer, thing);
    return out.take();
  }
};

TEST_F(FieldsTest, WhatIsAbsentKeepsItsValue) { EXPECT_EQ(read("{}"), Thing{}); }

TEST_F(FieldsTest, WhatIsWrittenIsReadBackToTheSameBits) {
  const Thing thing{.mass = 0.1 + 0.2,
                    .power = Milliwatts{1.0 / 3},
                    .reach = Metres{7.7},
                    .teeth = 0,
                    .period = 38300us,
                    .limit = std::nullopt,
                    .is_on = false,
                    .name = "a b: c",
                    .at = {-1.0 / 7, 0},
                    .colour = Colour::kBlue,
                    .discs = {{0.1}, {}},
                    .shape = Bar{{0.3, 1.0 / 9, 2}},
                    .slack = Metres{0.7},
                    .bolts = 0,
                    .trim = Colour::kBlue,
                    .rest = 3ms,
                    .note = "n",
                    .labels = {"a", "b, c"},
                    .grade = 'z',
                    .is_loud = true};
  EXPECT_EQ(read(written(thing)), thing);
  EXPECT_EQ(read(written(Thing{})), Thing{});
}

TEST_F(FieldsTest, WhatHangsOnAnotherKeyIsRefusedWithoutIt) {
  EXPECT_EQ(read("screws: 5").screws, 5);
  EXPECT_EQ(messages([&] { read("is_on: false\nscrews: 5\n"); }),
            std::vector<std::string>{"thing.yaml:2:1: screws: needs `is_on: true`"});
  EXPECT_EQ(written({.is_on = false}).find("screws"), std::string::npos);
}

TEST_F(FieldsTest, ItemsThatAreReadTakeThePlaceOfWhatWasThere) {
  auto document = config::Document::load(write("thing.yaml", "discs: [{radius: 4 m}]"));
  Mapping in = document.root();
  Thing thing{.discs = {{1}, {2}, {3}}};
  FieldReader reader(in);
  keys_of(reader, thing);
  document.finish();
  EXPECT_EQ(thing.discs, std::vector<Disc>{{4}});
}

TEST_F(FieldsTest, WhatIsNotGivenIsNotWritten) {
  const std::string text = written({});
  for (const char* key : {"slack", "bolts", "trim", "rest", "note", "is_loud"})
    EXPECT_EQ(text.find(key), std::string::npos) << key;
}

TEST_F(FieldsTest, TextWithAFormOfItsOwnIsParsedOrAMistake) {
  EXPECT_EQ(read("grade: c").grade, 'c');
  EXPECT_EQ(messages([&] { read("grade: cc"); }),
            std::vector<std::string>{"thing.yaml:1:8: grade: must be a letter"});
}

TEST_F(FieldsTest, AKindHasTheKeysOfItsAlternative) {
  const auto read_lid = [&](const std::string& text) {
    auto document = config::Document::load(write("thing.yaml", text));
    Mapping in = document.root();
    Thing thing;
    FieldReader reader(in);
    lid_key(reader, thing);
    in.finish();
    document.finish();
    return thing;
  };
  Thing thing{.lid = Bar{{1, 2, 3}}};
  Writer out;
  FieldWriter writer(out);
  lid_key(writer, thing);
  EXPECT_EQ(read_lid(out.take()), thing);
  EXPECT_EQ(messages([&] { read_lid("lid: {kind: rund, size: 1, other: 2}"); }),
            std::vector<std::string>{"thing.yaml:1:13: lid.kind: 'rund' is not one of round, long; "
                                     "did you mean 'round'?"});
  EXPECT_EQ(messages([&] { read_lid("lid: {radius: 1 m}"); }),
            std::vector<std::string>{"thing.yaml:1:6: lid.kind: is missing: one of round, long"});
}

TEST_F(FieldsTest, AMistakeHasTheKeysPlaceAndTheRestIsRead) {
  EXPECT_EQ(messages([&] { read("mass: 200 kg\nshape: {disc: {}}\ndiscs: [{radius: 1 s}]\n"); }),
            (std::vector<std::string>{
                "thing.yaml:1:7: mass: 200 kg is above the limit of 100 kg",
                "thing.yaml:2:15: shape.disc.radius: is missing: a number with its unit (m), 0 m "
                ".. 10 m, e.g. 1 m",
                "thing.yaml:3:18: discs.radius: '1 s' must be written in m, e.g. '1 m'"}));
}

TEST_F(FieldsTest, AlternativesExcludeEachOther) {
  EXPECT_EQ(messages([&] { read("shape: {disc: {radius: 1 m}, bar: {size: [1 m, 1 m, 1 m]}}"); }),
            (std::vector<std::string>{"thing.yaml:1:30: shape.bar: cannot be combined with disc"}));
  EXPECT_TRUE(std::holds_alternative<std::monostate>(read("shape: {}").shape));
}

TEST_F(FieldsTest, NamesAreThoseOfTheKeysInTheirOrder) {
  Thing thing;
  FieldNames names;
  keys_of(names, thing);
  names.unused("wings", "it has none");
  EXPECT_EQ(names.all(),
            (std::vector<std::string>{"mass",   "power", "reach",   "teeth",  "period", "limit",
                                      "is_on",  "name",  "at",      "colour", "discs",  "shape",
                                      "screws", "slack", "bolts",   "trim",   "rest",   "note",
                                      "labels", "grade", "is_loud", "wings"}));
  EXPECT_TRUE(names.has("at"));
  EXPECT_FALSE(names.has("radius")) << "stands inside";
  EXPECT_EQ(thing, Thing{});
}

}  // namespace
}  // namespace hal::files::description
