#include "hal/files/config/document.h"

#include "tests/unit/hal/files/config/files.h"

namespace hal::files::config {
namespace {

class DocumentTest : public Files {
 protected:
  Lines loading(const std::filesystem::path& file, const std::vector<std::string>& set = {}) {
    return messages([&] { Document::load(file, set).finish(); });
  }

  /// The plain number at a dotted path of two keys.
  static double number(Document& document, const std::string& outer, const std::string& inner) {
    Mapping root = document.root();
    return root.mapping(key(outer)).number(key(inner), "1", {-1e9, 1e9}, -1);
  }
};

TEST_F(DocumentTest, NamesAMissingFile) {
  EXPECT_EQ(loading(folder_ / "no.yaml"), (Lines{"no.yaml: there is no such file"}));
}

TEST_F(DocumentTest, NamesAFileThatIsCalledNearlyAsTheMissingOne) {
  write("walk.yaml", "a: 1\n");
  EXPECT_EQ(loading(folder_ / "wallk.yaml"),
            (Lines{"wallk.yaml: there is no such file; did you mean 'walk.yaml'?"}));
  EXPECT_EQ(loading(folder_ / "wallk"),
            (Lines{"wallk: there is no such file; did you mean 'walk.yaml'?"}));
  const auto found = loading(write("b.yaml", "x: {include: walkk.yaml}\n"));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found[0].ends_with("; did you mean 'walk.yaml'?")) << found[0];
}

TEST_F(DocumentTest, UrdfAndSdfNameModelsOfRobotsAndWorldsOnly) {
  const auto file = write("a.yaml", "parameters: {sdf: 3, drive: 4}\n");
  Document document = Document::load(file);
  Mapping parameters = document.root().mapping({"parameters", "Of a test.", "{}"});
  EXPECT_EQ(parameters.integer({"sdf", "Of a test.", "3"}, 0, 9), 3);
  EXPECT_EQ(parameters.integer({"drive", "Of a test.", "4"}, 0, 9), 4);
  EXPECT_EQ(loading(write("b.yaml", "robot: {urdf: no.urdf}\n")).size(), 1U);
}

TEST_F(DocumentTest, SaysWhatAFileIsThatIsNotYaml) {
  const std::string urdf =
      "is URDF, which a scenario takes as `robot: {urdf: FILE, drive: {left: JOINT, right: "
      "JOINT}}`";
  const std::string body = "<link name=\"base\"/></robot>\n";
  EXPECT_EQ(loading(write("a.urdf",
                          "<?xml version=\"1.0\"?>\n<!-- <sdf> -->\n<robot name=\"a\">" + body)),
            (Lines{"a.urdf: " + urdf}));
  EXPECT_EQ(loading(write("b.yaml", "\xef\xbb\xbf\n<robot>" + body)), (Lines{"b.yaml: " + urdf}));
  EXPECT_EQ(loading(write("a.sdf", "<sdf version='1.9'/>")),
            (Lines{"a.sdf: is SDF, which a scenario takes as `robot: {sdf: FILE}` or `world: {sdf: "
                   "FILE}`"}));
  for (const char* text : {"<html></html>", "<", "<!-- without end", "<?xml"}) {
    EXPECT_EQ(loading(write("a.xml", text)), (Lines{"a.xml: is XML, not YAML"})) << text;
  }
  const std::string database("SQLite format 3\0\x10", 17);
  EXPECT_EQ(
      loading(write("run.sqlite", database)),
      (Lines{"run.sqlite: is a database of SQLite, not YAML; `baraka report` and `baraka view` "
             "take a folder of results"}));
  EXPECT_EQ(loading(write("map.png", std::string("\x89PNG\0", 5))),
            (Lines{"map.png: is binary, not YAML"}));
  const auto included = loading(write("c.yaml", "x: {include: a.urdf}\n"));
  ASSERT_EQ(included.size(), 1U);
  EXPECT_TRUE(included[0].starts_with("a.urdf: is URDF")) << included[0];
  EXPECT_NE(included[0].find("c.yaml:1:14"), std::string::npos) << included[0];
}

TEST_F(DocumentTest, SaysOfAFolderWhetherItHoldsResults) {
  std::filesystem::create_directories(folder_ / "plain");
  EXPECT_EQ(loading(folder_ / "plain"), (Lines{"plain: is a directory, not a file"}));
  write("plain/run.sqlite", "");
  EXPECT_EQ(loading(folder_ / "plain"),
            (Lines{"plain: is a directory, not a file; it holds results: `baraka report` and "
                   "`baraka view` take a folder of results"}));
}

TEST_F(DocumentTest, GivesThePositionOfASyntaxError) {
  const auto found = loading(write("a.yaml", "a: 1\nb: [1, 2\nc: 3\n"));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].rfind("a.yaml:3:2: is not YAML: ", 0), 0u) << found[0];
}

TEST_F(DocumentTest, FindsRepeatedKeysAtEveryLevel) {
  EXPECT_EQ(
      loading(write("a.yaml", "a: 1\nb: {c: 1, c: 2}\na: 3\nl: [{d: 1, d: 2}]\n")),
      (Lines{"a.yaml:2:11: b.c: already set on line 2", "a.yaml:3:1: a: already set on line 1",
             "a.yaml:4:12: l.d: already set on line 4"}));
}

TEST_F(DocumentTest, RefusesWhatHidesWhereAValueComesFrom) {
  EXPECT_EQ(loading(write("a.yaml", "a: &x 1\nb: *x\nc: !!int 3\n")),
            (Lines{"a.yaml:1:4: anchors (&) are not supported",
                   "a.yaml:2:4: aliases (*) are not supported",
                   "a.yaml:3:4: tags (!) are not supported"}));
  EXPECT_EQ(loading(write("b.yaml", "a: 1\n---\nb: 2\n")).size(), 1u);
  EXPECT_EQ(loading(write("c.yaml", "[1, 2]: 3\n")),
            (Lines{"c.yaml:1:1: a key must be text, not a list of 2"}));
  EXPECT_EQ(loading(write("d.yaml", "- 1\n")),
            (Lines{"d.yaml:1:1: must be a mapping, not a list of 1"}));
}

TEST_F(DocumentTest, TakesAnEmptyFileAsAnEmptyMapping) {
  EXPECT_EQ(loading(write("a.yaml", "# nothing\n")), Lines{});
}

TEST_F(DocumentTest, PutsIncludedKeysUnderTheMappingsOwn) {
  write("sub/base.yaml", "a: 1\nb: 2\n");
  auto document = Document::load(write("a.yaml", "x: {include: sub/base.yaml, b: 20, c: 30}\n"));
  EXPECT_EQ(number(document, "x", "a"), 1);
  EXPECT_EQ(number(document, "x", "b"), 20);
  EXPECT_EQ(number(document, "x", "c"), 30);
}

TEST_F(DocumentTest, UnitesIncludedMappingsLevelByLevel) {
  write("base.yaml", "x: {a: 1, b: 2}\n");
  auto document = Document::load(write("a.yaml", "include: base.yaml\nx: {b: 20}\n"));
  EXPECT_EQ(number(document, "x", "a"), 1);
  EXPECT_EQ(number(document, "x", "b"), 20);
}

TEST_F(DocumentTest, FindsIncludedFilesRelativeToTheFileThatNamesThem) {
  write("one/two/leaf.yaml", "x: {a: 5}\n");
  write("one/middle.yaml", "include: two/leaf.yaml\n");
  auto document = Document::load(write("a.yaml", "include: one/middle.yaml\n"));
  EXPECT_EQ(number(document, "x", "a"), 5);
}

TEST_F(DocumentTest, PlacesMistakesInTheIncludedFile) {
  write("base.yaml", "a: 1\n\nb: far\n");
  const auto found = messages([&] {
    auto document = Document::load(write("a.yaml", "x: {include: base.yaml}\n"));
    Mapping root = document.root();
    root.mapping(key("x")).number(key("b"), "1", {0, 1});
    document.finish();
  });
  EXPECT_EQ(found, (Lines{"base.yaml:3:4: x.b: 'far' is not a number (included by a.yaml:1:14)"}));
}

TEST_F(DocumentTest, FindsCirclesOfIncludes) {
  write("b.yaml", "y: {include: c.yaml}\n");
  write("c.yaml", "\ninclude: a.yaml\n");
  EXPECT_EQ(loading(write("a.yaml", "x: {include: b.yaml}\n")),
            (Lines{"c.yaml:2:10: x.y.include: includes itself: a.yaml -> b.yaml -> c.yaml -> "
                   "a.yaml (included by b.yaml:1:14, that by a.yaml:1:14)"}));
  EXPECT_EQ(loading(write("self.yaml", "include: self.yaml\n")),
            (Lines{"self.yaml:1:10: include: includes itself: self.yaml -> self.yaml"}));
}

TEST_F(DocumentTest, MayIncludeOneFileTwice) {
  write("leaf.yaml", "a: 1\n");
  auto document =
      Document::load(write("a.yaml", "x: {include: leaf.yaml}\ny: {include: leaf.yaml}\n"));
  EXPECT_EQ(number(document, "y", "a"), 1);
}

TEST_F(DocumentTest, NamesTheIncludeThatLeadsNowhere) {
  EXPECT_EQ(
      loading(write("a.yaml", "x:\n  include: no.yaml\ny: {include: [1]}\n")),
      (Lines{"a.yaml:2:12: x.include: there is no file 'no.yaml', nor in the shared folders ()",
             "a.yaml:3:14: y.include: must be the path of a file, not a list of 1"}));
}

TEST_F(DocumentTest, LetsTheCommandLineWinOverFileAndIncludes) {
  write("base.yaml", "a: 1\nb: 2\n");
  auto document = Document::load(write("a.yaml", "x: {include: base.yaml, b: 20}\n"),
                                 {"x.a=100", "x.b=200", "x.c=300", "x.c=301"});
  EXPECT_EQ(number(document, "x", "a"), 100);
  EXPECT_EQ(number(document, "x", "b"), 200);
  EXPECT_EQ(number(document, "x", "c"), 301);
}

TEST_F(DocumentTest, LetsAnIncludeOfTheCommandLineReplaceAndOverride) {
  write("old.yaml", "a: 1\nold_only: 1\n");
  write("new.yaml", "a: 2\nb: 2\n");
  auto document =
      Document::load(write("a.yaml", "x: {include: old.yaml, b: 20}\n"), {"x.include=new.yaml"});
  EXPECT_EQ(number(document, "x", "a"), 2);
  EXPECT_EQ(number(document, "x", "b"), 2);
  EXPECT_EQ(number(document, "x", "old_only"), -1);
}

TEST_F(DocumentTest, LetsTheCommandLineReachIntoAnIncludedInclude) {
  write("old.yaml", "a: 1\n");
  write("new.yaml", "a: 2\n");
  write("base.yaml", "x: {include: old.yaml}\n");
  auto document = Document::load(write("a.yaml", "include: base.yaml\n"), {"x.include=new.yaml"});
  EXPECT_EQ(number(document, "x", "a"), 2);
}

TEST_F(DocumentTest, ReplacesAMappingThatTheCommandLineGivesWhole) {
  auto document = Document::load(write("a.yaml", "x: {a: 1, b: 2}\n"), {"x={b: 3}"});
  EXPECT_EQ(number(document, "x", "a"), -1);
  EXPECT_EQ(number(document, "x", "b"), 3);
}

TEST_F(DocumentTest, NamesOverridesThatCannotBeRead) {
  const auto file = write("a.yaml", "a: 1\n");
  const std::string usage = "must be KEY=VALUE, e.g. --set radio.tx_power='2 mW'";
  EXPECT_EQ(loading(file, {"a"}), (Lines{"--set a: " + usage}));
  EXPECT_EQ(loading(file, {"=1"}), (Lines{"--set =1: " + usage}));
  EXPECT_EQ(loading(file, {"a..b=1"}), (Lines{"--set a..b=1: " + usage}));
  const auto found = loading(file, {"a=[1"});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].rfind("--set a: is not YAML: ", 0), 0u) << found[0];
}

TEST_F(DocumentTest, NamesTheOverrideWhoseValueIsWrong) {
  const auto found = messages([&] {
    auto document = Document::load(write("a.yaml", "x: {a: 1}\n"), {"x.a=1 m", "x.aa=2"});
    Mapping root = document.root();
    Mapping x = root.mapping(key("x"));
    x.number(key("a"), "1", {0, 1});
    x.finish();
    root.finish();
    document.finish();
  });
  EXPECT_EQ(found, (Lines{"--set x.a: '1 m' must be a plain number, without a unit",
                          "--set x.aa: is not a known key; known here: a"}));
}

TEST_F(DocumentTest, TellsADirectoryFromAFileThatIsNotThere) {
  std::filesystem::create_directory(folder_ / "sub");
  EXPECT_EQ(loading(folder_ / "sub"), (Lines{"sub: is a directory, not a file"}));
  EXPECT_EQ(loading(write("a.yaml", "x: {include: sub}\n")),
            (Lines{"a.yaml:1:14: x.include: 'sub' is a directory, not a file"}));
  EXPECT_EQ(loading("/dev/null"), (Lines{"/dev/null: is not a regular file"}));
}

TEST_F(DocumentTest, FindsIncludesBesideTheFileThatALinkLeadsTo) {
  write("real/b.yaml", "a: 1\n");
  write("links/b.yaml", "a: 2\n");
  std::filesystem::create_symlink(write("real/a.yaml", "x: {include: b.yaml}\n"),
                                  folder_ / "links" / "a.yaml");
  auto document = Document::load(folder_ / "links" / "a.yaml");
  EXPECT_EQ(number(document, "x", "a"), 1);
}

/// Seconds would show: without its limit each of these takes minutes or all memory.
TEST_F(DocumentTest, RefusesIncludesThatDoubleWithoutEnd) {
  for (int i = 0; i < 40; ++i) {
    const std::string next = "f" + std::to_string(i + 1) + ".yaml";
    write("f" + std::to_string(i) + ".yaml",
          "x: {include: " + next + "}\ny: {include: " + next + "}\n");
  }
  write("f40.yaml", "a: 1\n");
  const Lines found = loading(folder_ / "f0.yaml");
  ASSERT_FALSE(found.empty());
  EXPECT_NE(found[0].find("include: is file 1001; at most 1000 are read"), std::string::npos)
      << found[0];
}

TEST_F(DocumentTest, RefusesIncludesInMappingsWithoutEnd) {
  std::string text = "include: last.yaml";
  for (int i = 0; i < 60; ++i) text = "x: {" + text + "}";
  write("last.yaml", "a: 1\n");
  const Lines found = loading(write("a.yaml", text + "\n"));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(found[0].find("include: is nested in 60 mappings; at most 50 are allowed"),
            std::string::npos)
      << found[0];
}

TEST_F(DocumentTest, RefusesWhatWouldFillTheMemory) {
  std::string list = "a: [0";
  for (int i = 0; i < 600'000; ++i) list += ",0";
  EXPECT_NE(loading(write("a.yaml", list + "]\n")).at(0).find("has more values than the 500000"),
            std::string::npos);
  EXPECT_EQ(loading(write("b.yaml", std::string(9U << 20U, '#'))),
            (Lines{"b.yaml: has 9437184 bytes; at most 8388608 are read"}));
  std::string keys;
  for (int i = 0; i < 10'001; ++i) keys += "k" + std::to_string(i) + ": 0\n";
  EXPECT_EQ(loading(write("c.yaml", keys)),
            (Lines{"c.yaml:10001:1: has 10001 keys; at most 10000 are read"}));
}

TEST_F(DocumentTest, RefusesABombOfAliasesWithoutBuildingIt) {
  std::string text = "a0: &a0 [x, x]\n";
  for (int i = 1; i < 60; ++i) {
    const std::string one = "*a" + std::to_string(i - 1);
    text += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + one + ", " + one + "]\n";
  }
  const Lines found = loading(write("a.yaml", text));
  EXPECT_EQ(found.size(), 60u + 2 * 59u);
  EXPECT_EQ(found.at(0), "a.yaml:1:5: anchors (&) are not supported");
}

TEST_F(DocumentTest, RefusesAnOverrideOfManyParts) {
  std::string path = "a";
  for (int i = 1; i < 60'000; ++i) path += ".a";
  const Lines found = loading(write("a.yaml", "a: 1\n"), {path + "=1"});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(found[0].find("has 60000 parts; at most 50 are read"), std::string::npos);
  EXPECT_LT(found[0].size(), 1500u);
}

TEST_F(DocumentTest, ShowsTerminalsNeitherControlCharactersNorEndlessWords) {
  const Lines found = messages([&] {
    Document document =
        Document::load(write("a.yaml", "\"\\e[2J\": 1\nb: " + std::string(100'000, 'x') + "\n"));
    Mapping root = document.root();
    root.number(key("b"), "1", {0, 1});
    root.finish();
    document.finish();
  });
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0], "a.yaml:1:1: \\x1b[2J: is not a known key; known here: b");
  EXPECT_NE(found[1].find("...(100002 bytes)..."), std::string::npos);
  EXPECT_LT(found[1].size(), 700u);
}

TEST_F(DocumentTest, SetsItemsOfListsByTheirNumber) {
  const auto file = write("a.yaml", "l: [{a: 1, b: 2}, {a: 3, b: 4}]\nv: [1, 2]\n");
  auto document = Document::load(file, {"l.1.a=30", "v.0=10"});
  Mapping root = document.root();
  std::vector<Mapping> items = root.mappings(key("l"));
  ASSERT_EQ(items.size(), 2u);
  EXPECT_EQ(items[0].number(key("a"), "1", {-1e9, 1e9}, -1), 1);
  EXPECT_EQ(items[1].number(key("a"), "1", {-1e9, 1e9}, -1), 30);
  EXPECT_EQ(items[1].number(key("b"), "1", {-1e9, 1e9}, -1), 4);
  EXPECT_EQ(root.vec2(key("v"), "1", {-1e9, 1e9}).x, 10);
}

TEST_F(DocumentTest, SetsItemsOfListsThatAreIncluded) {
  write("base.yaml", "l: [{a: 1}, {a: 3}]\n");
  auto document = Document::load(write("a.yaml", "x: {include: base.yaml}\n"), {"x.l.0={a: 7}"});
  Mapping root = document.root();
  EXPECT_EQ(root.mapping(key("x")).mappings(key("l"))[0].number(key("a"), "1", {-1e9, 1e9}, -1), 7);
}

TEST_F(DocumentTest, NamesTheNumberOfAnItemThatIsNotThere) {
  const auto file = write("a.yaml", "l: [{a: 1}, {a: 3}]\ne: []\n");
  EXPECT_EQ(loading(file, {"l.2.a=1"}),
            (Lines{"--set l.2.a: '2' is not an item: the list has 2, 0 to 1"}));
  EXPECT_EQ(loading(file, {"l.first.a=1"}),
            (Lines{"--set l.first.a: 'first' is not an item: the list has 2, 0 to 1"}));
  EXPECT_EQ(loading(file, {"l.-1.a=1"}),
            (Lines{"--set l.-1.a: '-1' is not an item: the list has 2, 0 to 1"}));
  EXPECT_EQ(loading(file, {"e.0.a=1"}), (Lines{"--set e.0.a: '0' is not an item: the list has 0"}));
}

TEST_F(DocumentTest, NamesTheNumberOfAnItemWithAMistake) {
  const auto file = write("a.yaml", "l: [{a: 1}, {a: 3}]\n");
  const auto found = messages([&] {
    auto document = Document::load(file, {"l.1.a=far"});
    Mapping root = document.root();
    for (Mapping& item : root.mappings(key("l"))) (void)item.number(key("a"), "1", {-1e9, 1e9}, -1);
    document.finish();
  });
  EXPECT_EQ(found, (Lines{"--set l.1.a: 'far' is not a number"}));
}

class ListEdits : public DocumentTest {
 protected:
  void SetUp() override {
    write("base.yaml", "l: [{name: a}, {kind: b}, {name: c, kind: b}]\n");
    write("none.yaml", "x: 1\n");
  }
  /// Names, or kinds, of the list `l`, or the mistakes.
  Lines items(const std::filesystem::path& file, const Lines& set = {}) {
    Lines names;
    Lines found = messages([&] {
      auto document = Document::load(file, set);
      Mapping root = document.root();
      for (Mapping& item : root.mappings(key("l"))) {
        const std::string name = item.text(key("name"), "");
        const std::string kind = item.text(key("kind"), "");
        names.push_back(name.empty() ? kind : name);
      }
      document.finish();
    });
    return found.empty() ? names : found;
  }
};

TEST_F(ListEdits, AddToTheListOfAnIncludedFileAndRemoveByNameOrKind) {
  EXPECT_EQ(items(write("a.yaml", "include: base.yaml\nl: {add: [{name: d}]}\n")),
            (Lines{"a", "b", "c", "d"}));
  EXPECT_EQ(items(write("b.yaml", "include: base.yaml\nl: {remove: [b, a]}\n")), (Lines{"c"}));
  EXPECT_EQ(items(write("c.yaml", "include: base.yaml\nl: {remove: [c], add: [{name: c}]}\n")),
            (Lines{"a", "b", "c"}))
      << "replaced";
  EXPECT_EQ(items(write("d.yaml", "include: base.yaml\nl: [{name: d}]\n")), (Lines{"d"}));
}

TEST_F(ListEdits, OfFilesThatIncludeEachOtherAllCount) {
  write("middle.yaml", "include: base.yaml\nl: {add: [{name: d}, {name: e}], remove: [a]}\n");
  EXPECT_EQ(items(write("a.yaml", "include: middle.yaml\nl: {add: [{name: f}], remove: [d, b]}\n")),
            (Lines{"c", "e", "f"}));
}

TEST_F(ListEdits, ComeFromTheCommandLineToo) {
  const auto file = write("a.yaml", "include: base.yaml\nl: {add: [{name: d}]}\n");
  EXPECT_EQ(items(file, {"l.add=[{name: e}]"}), (Lines{"a", "b", "c", "d", "e"}));
  EXPECT_EQ(items(folder_ / "base.yaml", {"l.remove=[a]", "l.0.name=z"}),
            (Lines{"--set l.remove: l: there is no 'a' to remove; the list has z, b, c"}));
  EXPECT_EQ(items(folder_ / "base.yaml", {"l={add: [{name: e}]}"}), (Lines{"a", "b", "c", "e"}));
}

TEST_F(ListEdits, AddToNoListMakesOne) {
  EXPECT_EQ(items(write("a.yaml", "include: none.yaml\nl: {add: [{name: d}]}\n")), (Lines{"d"}));
  EXPECT_EQ(items(write("b.yaml", "l: {remove: [a]}\n")),
            (Lines{"b.yaml:1:14: l: there is no 'a' to remove; the list has none"}));
}

TEST_F(ListEdits, SayWhatIsWrongWithThem) {
  EXPECT_EQ(items(write("a.yaml", "include: base.yaml\nl: {add: {name: d}}\n")),
            (Lines{"a.yaml:2:5: l: add must be a list of items, not a mapping"}));
  EXPECT_EQ(items(write("b.yaml", "include: base.yaml\nl: {remove: a}\n")),
            (Lines{"b.yaml:2:5: l: remove must be a list of names, not 'a'"}));
  EXPECT_EQ(items(write("c.yaml", "include: base.yaml\nl: {remove: [z, {name: a}]}\n")).size(), 2u);
  EXPECT_EQ(items(write("d.yaml", "l: {add: 3}\n")),
            (Lines{"d.yaml:1:5: l: add must be a list of items, not '3'"}));
  EXPECT_EQ(items(write("e.yaml", "include: base.yaml\nl: {ad: []}\n")),
            (Lines{"e.yaml:2:4: l: must be a list, not a mapping"}));
}

}  // namespace
}  // namespace hal::files::config
