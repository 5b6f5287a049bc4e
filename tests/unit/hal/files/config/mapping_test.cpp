#include "hal/files/config/mapping.h"

#include "tests/unit/hal/files/config/files.h"

namespace hal::files::config {
namespace {

using namespace std::chrono_literals;

const std::vector<std::string> kPhases{"aligned", "uniform"};

class MappingTest : public Files {
 protected:
  /// Reads a file with `text` by `read` and gives all mistakes.
  template <class Read>
  Lines mistakes(const std::string& text, Read read) {
    return messages([&] {
      Document document = Document::load(write("a.yaml", text));
      Mapping root = document.root();
      read(root);
      root.finish();
      document.finish();
    });
  }
};

TEST_F(MappingTest, ReadsEveryKindOfValue) {
  const auto none = mistakes(
      "power: 20 dBm\ncount: 12\nwait: 250 ms\non: true\nname: m{}\nat: [1 m, -2 cm]\n"
      "size: [1 m, 2 m, 3 m]\nphase: uniform\nlist: [a, b]\ninner: {x: 1}\nitems: [{y: 2}, {y: "
      "3}]\n"
      "timeout: none\n",
      [](Mapping& in) {
        EXPECT_EQ(in.number(key("power"), "dBm", {-30, 30}), 20);
        EXPECT_EQ(in.integer(key("count"), 0, 12), 12);
        EXPECT_EQ(in.duration(key("wait"), {0, 1}), 250ms);
        EXPECT_TRUE(in.flag(key("on"), false));
        EXPECT_EQ(in.text(key("name")), "m{}");
        EXPECT_EQ(in.vec2(key("at"), "m", {-5, 5}), (Vec2{1, -0.02}));
        EXPECT_EQ(in.vec3(key("size"), "m", {0, 5}), (Vec3{1, 2, 3}));
        EXPECT_EQ(in.choice(key("phase"), kPhases), 1u);
        EXPECT_EQ(in.texts(key("list")).at(1).text, "b");
        Mapping inner = in.mapping(key("inner"));
        EXPECT_EQ(inner.number(key("x"), "1", {0, 1}), 1);
        EXPECT_EQ(in.mappings(key("items")).at(1).number(key("y"), "1", {0, 9}), 3);
        EXPECT_EQ(in.optional_duration(key("timeout"), 0, 1s), std::nullopt);
      });
  EXPECT_EQ(none, Lines{});
}

TEST_F(MappingTest, KeepsWhatIsOtherwiseTrueForAbsentKeys) {
  const auto none = mistakes("{}\n", [](Mapping& in) {
    EXPECT_EQ(in.number(key("power"), "dBm", {-30, 30}, 7), 7);
    EXPECT_EQ(in.integer(key("count"), 0, 12, 3), 3);
    EXPECT_EQ(in.duration(key("wait"), {0, 1}, 5s), 5s);
    EXPECT_TRUE(in.flag(key("on"), true));
    EXPECT_EQ(in.text(key("name"), "x"), "x");
    EXPECT_EQ(in.optional_duration(key("timeout"), 0, 1s), 1s);
    EXPECT_EQ(in.choice(key("phase"), kPhases, 1), 1u);
    EXPECT_TRUE(in.mappings(key("items")).empty());
    EXPECT_TRUE(in.texts(key("list")).empty());
  });
  EXPECT_EQ(none, Lines{});
}

TEST_F(MappingTest, ReportsAllMistakesSortedByPosition) {
  const auto found = mistakes("z: 9 m\na: nan\nunknown: 1\nb: {c: 99}\n", [](Mapping& in) {
    Mapping b = in.mapping(key("b"));
    b.integer(key("c"), 0, 10);
    b.number(key("d"), "s", {0, 1});
    b.finish();
    in.number(key("a"), "1", {0, 1});
    in.number(key("z"), "m", {0, 1});
  });
  EXPECT_EQ(found, (Lines{"a.yaml:1:4: z: 9 m is above the limit of 1 m",
                          "a.yaml:2:4: a: 'nan' is not a number",
                          "a.yaml:3:1: unknown: is not a known key; known here: b, a, z",
                          "a.yaml:4:4: b.d: is missing: a number with its unit (s), 0 s .. 1 s",
                          "a.yaml:4:8: b.c: 99 is above the limit of 10"}));
}

TEST_F(MappingTest, SuggestsTheKeyThatWasMeantAmongThoseAskedFor) {
  const auto found = mistakes("cca_treshold: -80 dBm\n", [](Mapping& in) {
    in.number(key("cca_threshold"), "dBm", {-99, 0}, 0);
  });
  EXPECT_EQ(found, (Lines{"a.yaml:1:1: cca_treshold: is not a known key; did you mean "
                          "'cca_threshold'? Known here: cca_threshold"}));
}

TEST_F(MappingTest, TakesOnlyPlainTrueAndFalseAsFlags) {
  const auto found = mistakes("a: yes\nb: \"true\"\nc: 1\nd: True\n", [](Mapping& in) {
    for (const char* name : {"a", "b", "c", "d"}) in.flag(key(name), false);
  });
  EXPECT_EQ(found, (Lines{"a.yaml:1:4: a: must be true or false, not 'yes'",
                          "a.yaml:2:4: b: must be true or false, not 'true'",
                          "a.yaml:3:4: c: must be true or false, not '1'",
                          "a.yaml:4:4: d: must be true or false, not 'True'"}));
}

TEST_F(MappingTest, TakesOnlyWholeDecimalNumbersAsIntegers) {
  const auto found = mistakes("a: 1.5\nb: 0x10\nc: 99999999999999999999\nd: -5\ne: ten\nf: 5 s\n",
                              [](Mapping& in) {
                                for (const char* name : {"a", "b", "c", "d", "e", "f"}) {
                                  in.integer(key(name), 0, 100);
                                }
                              });
  EXPECT_EQ(found, (Lines{"a.yaml:1:4: a: '1.5' is not a whole number",
                          "a.yaml:2:4: b: '0x10' is not a whole number",
                          "a.yaml:3:4: c: 99999999999999999999 is above the limit of 100",
                          "a.yaml:4:4: d: -5 is below the limit of 0",
                          "a.yaml:5:4: e: 'ten' is not a whole number",
                          "a.yaml:6:4: f: '5 s' is not a whole number"}));
}

TEST_F(MappingTest, NamesTheKindThatWasExpected) {
  const auto found = mistakes("a: [1 m]\nb: 3\nc: {x: 1}\nd:\ne: [1 m]\nf: x\n", [](Mapping& in) {
    in.number(key("a"), "m", {0, 1});
    Mapping b = in.mapping(key("b"));
    b.number(key("never_missed"), "1", {0, 1});  // what is not a mapping lacks no keys
    in.mappings(key("c"));
    in.number(key("d"), "1", {0, 1});
    in.vec2(key("e"), "m", {0, 1});
    EXPECT_EQ(in.choice(key("f"), kPhases), std::nullopt);
  });
  EXPECT_EQ(found,
            (Lines{"a.yaml:1:4: a: must be a number with its unit (m), not a list of 1",
                   "a.yaml:2:4: b: must be a mapping, not '3'",
                   "a.yaml:3:4: c: must be a list, not a mapping",
                   "a.yaml:4:1: d: must be a plain number, not nothing",
                   "a.yaml:5:4: e: must be a list of 2 values, [x, y], each a number with its "
                   "unit (m), not a list of 1",
                   "a.yaml:6:4: f: 'x' is not one of aligned, uniform"}));
}

TEST_F(MappingTest, RefusesAKeyWithItsReason) {
  const auto found = mistakes("range: 5 m\n", [](Mapping& in) {
    in.refuse("range", "is not used by the profile 'x'");
    in.refuse("absent", "is not there");
  });
  EXPECT_EQ(found, (Lines{"a.yaml:1:1: range: is not used by the profile 'x'"}));
}

TEST_F(MappingTest, GivesThePlainValuesOfAMappingWithTheirPlaces) {
  const auto none =
      mistakes("help_at: 1 s\nrepeat: never\nway: [1 m, 2 m]\nno: []\n", [this](Mapping& in) {
        const auto values = in.plain_values();
        ASSERT_EQ(values.size(), 4u);
        EXPECT_EQ(values[0].key, "help_at");
        EXPECT_EQ(values[0].text, "1 s");
        EXPECT_FALSE(values[0].is_list);
        EXPECT_EQ(values[1].place, folder_.string() + "/a.yaml:2:9");
        EXPECT_TRUE(values[2].is_list);
        EXPECT_EQ(values[2].items, (std::vector<std::string>{"1 m", "2 m"}));
        EXPECT_TRUE(values[3].is_list);
        EXPECT_TRUE(values[3].items.empty());
      });
  EXPECT_EQ(none, Lines{});
}

TEST_F(MappingTest, RefusesAPlainValueThatIsNone) {
  const auto found = mistakes("a: {b: 1}\nc: [[1], 2]\n", [](Mapping& in) { in.plain_values(); });
  EXPECT_EQ(found, (Lines{"a.yaml:1:4: a: must be a single value or a list of them, not a mapping",
                          "a.yaml:2:5: c: must be a single value, not a list of 1"}));
}

TEST_F(MappingTest, JoinsTheKeysOfMappingsInside) {
  const auto none = mistakes("a: 1 s\nb: {c: [1, 2], d: {e: x}}\nf: {}\n", [this](Mapping& in) {
    const auto values = in.nested_values();
    ASSERT_EQ(values.size(), 3u);
    EXPECT_EQ(values[0].key, "a");
    EXPECT_EQ(values[1].key, "b.c");
    EXPECT_EQ(values[1].items, (std::vector<std::string>{"1", "2"}));
    EXPECT_EQ(values[2].key, "b.d.e");
    EXPECT_EQ(values[2].text, "x");
    EXPECT_EQ(values[2].place, folder_.string() + "/a.yaml:2:23");
  });
  EXPECT_EQ(none, Lines{});
  const auto found = mistakes("a: {b: [[1], 2]}\n", [](Mapping& in) { in.nested_values(); });
  EXPECT_EQ(found, Lines{"a.yaml:1:9: a.b: must be a single value, not a list of 1"});
}

TEST_F(MappingTest, LimitsAnOptionalTimeToWhatADurationHolds) {
  const auto found = mistakes("timeout: 1e30 s\n",
                              [](Mapping& in) { in.optional_duration(key("timeout"), 0, 1s); });
  EXPECT_EQ(found, (Lines{"a.yaml:1:10: timeout: must be at most 1000000000 s or 'none'"}));
}

}  // namespace
}  // namespace hal::files::config
