#include "hal/files/config/writer.h"

#include "tests/unit/hal/files/config/files.h"

namespace hal::files::config {
namespace {

using namespace std::chrono_literals;

class WriterTest : public Files {};

TEST(FormatDuration, TakesTheLargestUnitThatIsWhole) {
  EXPECT_EQ(format_duration(0ns), "0 s");
  EXPECT_EQ(format_duration(3600s), "3600 s");
  EXPECT_EQ(format_duration(1500ms), "1500 ms");
  EXPECT_EQ(format_duration(20us), "20 us");
  EXPECT_EQ(format_duration(695454ns), "695454 ns");
}

TEST(WriterText, IsYamlInTheShapePeopleWrite) {
  Writer out;
  out.integer("version", 1);
  out.open("radio");
  out.number("range", 250.16, "m");
  out.close();
  out.open_list("walls");
  out.open_item();
  out.text("name", "w 0");
  out.numbers("size", {0.3, 20}, "m");
  out.close();
  out.close();
  out.open("routing");
  out.close();
  out.open_list("expect");
  out.close();
  EXPECT_EQ(out.take(),
            "version: 1\n"
            "radio:\n"
            "  range: 250.16 m\n"
            "walls:\n"
            "  - name: w 0\n"
            "    size: [0.3 m, 20 m]\n"
            "routing: {}\n"
            "expect: []\n");
  using Values = std::vector<std::pair<std::string, std::string>>;
  EXPECT_EQ(out.values(), (Values{{"version", "1"},
                                  {"radio.range", "250.16 m"},
                                  {"walls.0.name", "w 0"},
                                  {"walls.0.size", "[0.3 m, 20 m]"},
                                  {"routing", "{}"},
                                  {"expect", "[]"}}));
}

TEST_F(WriterTest, QuotesWhatYamlWouldReadAsSomethingElse) {
  const Lines texts = {"m{}", "- x", "a: b",        "a # b", "\"q\"",      "back\\slash",
                       "*",   "~",   "line\nbreak", "'x'",   "plain text", "-5 deg",
                       "[1]", "äö",  "x:",          "null"};
  Writer out;
  for (std::size_t i = 0; i < texts.size(); ++i) out.text("k" + std::to_string(i), texts[i]);
  auto document = Document::load(write("a.yaml", out.take()));
  Mapping root = document.root();
  for (std::size_t i = 0; i < texts.size(); ++i) {
    EXPECT_EQ(root.text(key("k" + std::to_string(i))), texts[i]);
  }
  document.finish();
}

TEST_F(WriterTest, KeepsEveryDurationToTheNanosecond) {
  const std::vector<Duration> durations = {1ns, 999'999'999ns, 1h, 86'400'000'000'001ns, 7us};
  Writer out;
  for (std::size_t i = 0; i < durations.size(); ++i) {
    out.duration("k" + std::to_string(i), durations[i]);
  }
  auto document = Document::load(write("a.yaml", out.take()));
  Mapping root = document.root();
  for (std::size_t i = 0; i < durations.size(); ++i) {
    EXPECT_EQ(root.duration(key("k" + std::to_string(i)), {0, kLongestDuration}), durations[i]);
  }
}

}  // namespace
}  // namespace hal::files::config
