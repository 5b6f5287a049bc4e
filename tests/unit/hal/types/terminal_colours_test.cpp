#include "hal/types/terminal_colours.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

namespace hal {
namespace {

// Escape sequences of ECMA-48, 5th edition, 8.3.117, with the colours of 30 to 37.
std::string bold(const std::string& text) { return "\x1b[1m" + text + "\x1b[0m"; }
std::string red(const std::string& text) { return "\x1b[1m\x1b[31m" + text + "\x1b[0m"; }
std::string yellow(const std::string& text) { return "\x1b[1m\x1b[33m" + text + "\x1b[0m"; }

TEST(Coloured, APlaceIsBoldAndTheKeyAfterItRed) {
  EXPECT_EQ(coloured(Tone::kMistake, "a.yaml:2:11: tx_power: 45 dBm is above: 30 dBm"),
            bold("a.yaml:2:11:") + " " + red("tx_power:") + " 45 dBm is above: 30 dBm");
}

TEST(Coloured, AWordThatBeginsTheTextIsAllThatIsColoured) {
  EXPECT_EQ(coloured(Tone::kMistake, "error: a: b: c\nKinds: d"),
            red("error:") + " a: b: c\nKinds: d");
  EXPECT_EQ(coloured(Tone::kMistake, "not met: result: over"), red("not met:") + " result: over");
  EXPECT_EQ(coloured(Tone::kWarning, "warning: slow"), yellow("warning:") + " slow");
}

TEST(Coloured, EachLineOfSeveralMistakesHasAPlace) {
  EXPECT_EQ(coloured(Tone::kMistake, "a: k: x\n--set b: y\n"),
            bold("a:") + " " + red("k:") + " x\n" + bold("--set b:") + " y\n");
}

TEST(Coloured, TheWordOfAWarningIsYellow) {
  EXPECT_EQ(coloured(Tone::kWarning, "a.yaml:1:1: warning: end: never holds"),
            bold("a.yaml:1:1:") + " " + yellow("warning:") + " end: never holds");
}

TEST(Coloured, WhatHasNoPlaceStaysAsItIs) {
  for (const char* text : {"", "and 3 more mistakes", "  indented: line: x", "errors"}) {
    EXPECT_EQ(coloured(Tone::kMistake, text), text);
  }
}

TEST(Coloured, AClauseIsNoKey) {
  EXPECT_EQ(coloured(Tone::kMistake, "a.yaml: cannot be read: no such file"),
            bold("a.yaml:") + " cannot be read: no such file");
}

TEST(Coloured, ResultsAreBoldAndProgressIsFaint) {
  EXPECT_EQ(coloured(Tone::kResult, "result:"), bold("result:"));
  EXPECT_EQ(coloured(Tone::kProgress, "1 of 2: 50 %"), "\x1b[2m1 of 2: 50 %\x1b[0m");
}

TEST(Coloured, AStreamThatIsNoTerminalGetsTheTextAsItIs) {
  std::FILE* const file = std::tmpfile();
  ASSERT_NE(file, nullptr);
  EXPECT_FALSE(shows_colours(file));
  EXPECT_EQ(coloured_for(file, Tone::kMistake, "error: x"), "error: x");
  std::fclose(file);
}

}  // namespace
}  // namespace hal
