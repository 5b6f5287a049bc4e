#include "hal/robot/drivers/json_numbers.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace hal::robot::drivers {
namespace {

TEST(JsonNumbers, AreReadWithAnyWhiteSpace) {
  const auto numbers = parse_json_numbers(" [1, -2.5e1\t,\n0.125,1E2]\r\n", 4);
  ASSERT_TRUE(numbers) << numbers.error().message;
  EXPECT_EQ(*numbers, (std::vector<double>{1, -25, 0.125, 100}));
  EXPECT_TRUE(parse_json_numbers("[]", 0));
}

TEST(JsonNumbers, OfAnotherCountAreRefused) {
  const auto short_array = parse_json_numbers("[1,2]", 3);
  ASSERT_FALSE(short_array);
  EXPECT_EQ(short_array.error().code, Errc::kProtocol);
  EXPECT_EQ(short_array.error().message, "2 numbers, 3 expected: '[1,2]'");
}

/// RFC 8259, 6: no leading zeros or plus, digits round the point, no NaN and no infinity.
TEST(JsonNumbers, AgainstTheGrammarAreRefused) {
  for (const std::string text :
       {"",       "[",       "]",      "[1",        "1]",    "[1,]",   "[,1]",
        "[1 2]",  "[1]x",    "[[1]]",  "{\"a\":1}", "[nan]", "[inf]",  "[-Infinity]",
        "[+1]",   "[01]",    "[-01]",  "[1.]",      "[.5]",  "[1.e3]", "[1e999]",
        "[0x10]", "[\"1\"]", "[true]", "[null]",    "[-]",   "[1e]"}) {
    EXPECT_FALSE(parse_json_numbers(text, 1)) << text;
  }
}

TEST(JsonNumbers, LongAndUnprintableAnswersAreCutInMessages) {
  const auto answer = parse_json_numbers(std::string(5000, 'x') + "\n", 1);
  ASSERT_FALSE(answer);
  EXPECT_LT(answer.error().message.size(), 150U);
  const auto binary = parse_json_numbers(std::string("\x01\n\xff", 3), 1);
  ASSERT_FALSE(binary);
  EXPECT_NE(binary.error().message.find(std::string(3, '?')), std::string::npos)
      << binary.error().message;
}

TEST(JsonNumbers, AreWrittenAsTheyReadBack) {
  const std::array<double, 4> numbers{0.1, -0.30000000000000004, 0, 1e-300};
  const std::string text = json_numbers(numbers);
  EXPECT_EQ(text, "[0.1,-0.30000000000000004,0,1e-300]");
  EXPECT_EQ(*parse_json_numbers(text, 4), std::vector<double>(numbers.begin(), numbers.end()));
}

}  // namespace
}  // namespace hal::robot::drivers
