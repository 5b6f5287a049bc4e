#include "hal/types/printable.h"

#include <gtest/gtest.h>

#include "hal/types/log.h"

namespace hal {
namespace {

TEST(Printable, LeavesTextInAnyScriptAlone) {
  for (const char* text : {"", "r0: ok\tyes", "Müller, 机器人, 🤖, é", "100 %d {} \\x1b"}) {
    EXPECT_EQ(printable(text), text);
  }
}

TEST(Printable, ShowsEscapeSequencesInsteadOfObeyingThem) {
  EXPECT_EQ(printable("\033[2J\033]0;owned\007"), "\\x1b[2J\\x1b]0;owned\\x07");
  EXPECT_EQ(printable("\rerror\b\177"), "\\x0derror\\x08\\x7f");
  EXPECT_EQ(printable("\u009b2J"), "\\xc2\\x9b2J");  // CSI as one character of C1
  EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
}

TEST(Printable, ShowsBytesThatAreNoUtf8) {
  EXPECT_EQ(printable("\x9b"
                      "2J"),
            "\\x9b2J");                                              // CSI to a terminal of 8 bits
  EXPECT_EQ(printable("\xC0\x9B"), "\\xc0\\x9b");                    // overlong ESC
  EXPECT_EQ(printable("\xED\xA0\x80"), "\\xed\\xa0\\x80");           // a surrogate
  EXPECT_EQ(printable("\xF4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");  // beyond U+10FFFF
  EXPECT_EQ(printable("Stra\xC3"), "Stra\\xc3");                     // cut in the middle
}

TEST(Printable, KeepsLinesWhereLinesAreMeant) {
  EXPECT_EQ(printable("a\nb"), "a\\nb");
  EXPECT_EQ(printable_lines("a\n\033b\n"), "a\n\\x1bb\n");
}

std::string last_line;
void remember(log::Level, Time, std::string_view where, std::string_view text) {
  last_line = std::string(where) + ": " + std::string(text);
}

TEST(Log, NoTextOfAControllerReachesASinkAsItIs) {
  log::set_sink(remember);
  log::write(log::Level::kWarning, Time{}, "r0\033[1m", "\033[31mall is well\n[0] error r1: dead");
  EXPECT_EQ(last_line, "r0\\x1b[1m: \\x1b[31mall is well\\n[0] error r1: dead");
}

TEST(Log, LevelsAreCalledByName) {
  EXPECT_EQ(log::level_called("debug"), log::Level::kDebug);
  EXPECT_EQ(log::level_called("error"), log::Level::kError);
  EXPECT_FALSE(log::level_called("loud").has_value());
}

}  // namespace
}  // namespace hal
