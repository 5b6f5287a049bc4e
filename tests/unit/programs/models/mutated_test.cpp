// Files, each with a few octets or an element changed: a message with a place, or a robot.
// BARAKA_MUTATED_MODELS tells how many.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <random>
#include <regex>

#include "hal/files/config/model_reader.h"
#include "tests/unit/programs/models/loaded.h"

namespace programs::models::test {
namespace {

std::string text_of(const std::string& file) {
  std::ifstream stream(robots() + file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Equal numbers on every machine, as the standard has it of this generator.
class Random {
 public:
  explicit Random(std::uint64_t seed) : generator_(seed) {}
  std::size_t below(std::size_t bound) { return generator_() % bound; }

 private:
  std::mt19937_64 generator_;
};

/// Start and length of a word of the file: a tag, an attribute, a number.
std::pair<std::size_t, std::size_t> some_word(const std::string& text, Random& random) {
  static const std::string kEnds = " \n<>\"=/";
  std::size_t begin = text.find_first_not_of(kEnds, random.below(text.size() - 1));
  if (begin == std::string::npos) begin = 0;
  return {begin, text.find_first_of(kEnds, begin) - begin};
}

std::string mutated(std::string text, Random& random) {
  static const std::array<std::string, 12> kWords{"nan", "-1",  "1e400", "",  "0",    "1e30",
                                                  "é",   "xyz", "base",  "<", "-0.0", "mesh"};
  for (std::size_t changes = 1 + random.below(3); changes > 0; --changes) {
    const auto [at, length] = some_word(text, random);
    switch (random.below(5)) {
      case 0:
        text.replace(at, length, kWords[random.below(kWords.size())]);
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2: {  // a line away
        const std::size_t begin = text.rfind('\n', at) + 1;
        text.erase(begin, text.find('\n', at) - begin);
        break;
      }
      case 3: {  // a line twice
        const std::size_t begin = text.rfind('\n', at) + 1;
        text.insert(begin, text.substr(begin, text.find('\n', at) + 1 - begin));
        break;
      }
      default:
        text[at] = static_cast<char>(random.below(256));
    }
  }
  return text;
}

const std::array<const char*, 10> kFiles{
    "turtlebot3_burger.urdf", "fixed_chain.urdf", "shapes.urdf",    "meshes.urdf", "left_out.urdf",
    "gz_drive.sdf",           "frames.sdf",       "two_models.sdf", "nested.sdf",  "shapes.sdf"};

int files_asked() {
  const char* const given = std::getenv("BARAKA_MUTATED_MODELS");
  return given == nullptr ? 50 : std::atoi(given);
}

TEST(MutatedModels, GiveAMessageWithAPlaceOrARobot) {
  const Folder folder;
  const std::regex at_a_line("^[^\n]*model\\.(urdf|sdf):[1-9][0-9]*:1: [^\n]+$"),
      of_the_drive("^drive[a-z.]*: [^\n]+$");
  const int files = files_asked();
  int good = 0, refused = 0;
  for (int i = 0; i < files; ++i) {
    const std::string name = kFiles[static_cast<std::size_t>(i) % kFiles.size()];
    Random random(static_cast<std::uint64_t>(i));
    const std::string text = mutated(text_of(name), random);
    const auto file = folder.write(name.ends_with("urdf") ? "model.urdf" : "model.sdf", text);
    const bool is_burger = name.starts_with("turtlebot3");
    const auto reading = hal::files::config::read_model(
        {"--robot-path", robots(), "--drive",
         is_burger ? "{left: wheel_left_joint, right: wheel_right_joint}"
                   : "{left: left_joint, right: right_joint}",
         "--model", name == "two_models.sdf" ? "second" : "", file});
    (reading.mistakes.empty() ? good : refused) += 1;
    EXPECT_EQ(reading.mistakes.empty(), reading.yaml.starts_with("# from ")) << i << name;
    for (const std::string& one : reading.mistakes) {
      EXPECT_TRUE(std::regex_match(one, at_a_line) || std::regex_match(one, of_the_drive))
          << i << ' ' << name << ": " << one;
      EXPECT_EQ(one.find("by a signal"), std::string::npos) << i << ' ' << name << ": " << one;
    }
  }
  // Neither is a claim about the reader: both must have been tried.
  EXPECT_GT(good, files / 10);
  EXPECT_GT(refused, files / 3);
}

}  // namespace
}  // namespace programs::models::test
