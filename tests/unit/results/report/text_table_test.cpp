#include "results/report/text_table.h"

#include <gtest/gtest.h>

namespace results::report {
namespace {

TEST(TextTable, AlignsTheFirstColumnLeftAndTheOthersRight) {
  TextTable table({"figure", "paper"});
  table.add_row({"a", "1.25"});
  table.add_row({"longest one", "1000.00"});
  EXPECT_EQ(table.text(),
            "figure         paper\n"
            "a               1.25\n"
            "longest one  1000.00\n");
}

TEST(TextTable, RowsMayBeShortAndEndWithoutBlanks) {
  TextTable table({"a", "b", "c"});
  table.add_row({"x"});
  table.add_row({"y", ""});
  EXPECT_EQ(table.text(), "a  b  c\nx\ny\n");
}

}  // namespace
}  // namespace results::report
