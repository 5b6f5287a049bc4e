#include "view/server/json_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

namespace view::server {
namespace {

std::string text_of(const auto& value) {
  std::string text;
  append_json(text, value);
  return text;
}

TEST(JsonText, StringsReadBackAsTheyWere) {
  for (const std::string& text : {std::string("a \"b\" \\ \n\t\x01\x7f"),
                                  std::string("m\xC3\xBC"
                                              "de \xF0\x9F\x90\x9C"),
                                  std::string("nul\0in it", 9), std::string()}) {
    EXPECT_EQ(nlohmann::json::parse(text_of(text)).get<std::string>(), text);
  }
}

TEST(JsonText, NothingEndsTheScriptOfAPage) {
  EXPECT_EQ(text_of("</script><!--").find('<'), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(text_of("</script>")).get<std::string>(), "</script>");
}

TEST(JsonText, WhatIsNoUtf8IsReplacedByteByByte) {
  const std::string replaced = "\xEF\xBF\xBD";
  // A lone continuation, a cut character, an overlong '/', a surrogate, beyond U+10FFFF.
  for (const auto& [bytes, count] : {std::pair{std::string("\x80"), 1},
                                     {std::string("\xE2\x82"), 2},
                                     {std::string("\xC0\xAF"), 2},
                                     {std::string("\xED\xA0\x80"), 3},
                                     {std::string("\xF4\x90\x80\x80"), 4}}) {
    std::string expected;
    for (int i = 0; i < count; ++i) expected += replaced;
    EXPECT_EQ(text_of(bytes), "\"" + expected + "\"");
  }
}

TEST(JsonText, NumbersReadBackToTheSameBits) {
  for (const double number : {0.1, -1e-300, 1.0 / 3, 6.02e23, 5.0}) {
    EXPECT_EQ(nlohmann::json::parse(text_of(number)).get<double>(), number);
  }
  EXPECT_EQ(text_of(INT64_MAX), "9223372036854775807");
  EXPECT_EQ(text_of(INT64_MIN), "-9223372036854775808");
  EXPECT_EQ(text_of(std::nan("")), "null");
  EXPECT_EQ(text_of(std::numeric_limits<double>::infinity()), "null");
}

}  // namespace
}  // namespace view::server
