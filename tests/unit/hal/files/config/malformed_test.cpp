#include "hal/types/random.h"
#include "tests/unit/hal/files/config/files.h"

namespace hal::files::config {
namespace {

class Malformed : public Files {};

constexpr std::string_view kText =
    "version: 1\nname: \"x y\"\nlist: [1 m, {a: 2}, 'q']\ninner:\n  - {b: [3, 4]}\n  - c: |\n"
    "      text\nlast: -5 deg  # comment\n";

/// The text with up to four bytes replaced, removed or doubled.
std::string damaged(RandomStream& random) {
  constexpr std::string_view kBytes = "{}[]:,-#&*!|>'\"%@`\t\n \x01\xff?~0a";
  std::string text(kText);
  for (std::uint32_t edits = 1 + random.below(4); edits > 0; --edits) {
    const std::size_t at = random.below(static_cast<std::uint32_t>(text.size()));
    const char byte = kBytes[random.below(static_cast<std::uint32_t>(kBytes.size()))];
    switch (random.below(3)) {
      case 0:
        text[at] = byte;
        break;
      case 1:
        text.erase(at, 1 + random.below(5));
        break;
      default:
        text.insert(at, 1, byte);
    }
  }
  return text;
}

// Whatever the bytes are, there is either a document or an error with a message: no crash, no
// other exception.
TEST_F(Malformed, TextEndsInADocumentOrAnErrorThatSaysSomething) {
  RandomStream random(1, "malformed");
  int refused = 0;
  for (int i = 0; i < 500; ++i) {
    const auto file = write("a.yaml", damaged(random));
    for (const std::string& message : messages([&] { Document::load(file).finish(); })) {
      EXPECT_EQ(message.rfind("a.yaml:", 0), 0u) << message;
      ++refused;
    }
  }
  EXPECT_GT(refused, 50);
}

}  // namespace
}  // namespace hal::files::config
