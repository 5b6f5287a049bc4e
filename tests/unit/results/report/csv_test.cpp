#include "results/report/csv.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/unit/results/record/test_run.h"

namespace results::report::test {
namespace {

using record::test::Folder;
using record::test::make_result;

std::string csv(const std::filesystem::path& folder, std::string_view table) {
  std::string text;
  write_csv(folder, table, [&text](std::string_view part) { text += part; });
  return text;
}

// RFC 4180, 2: fields with quotes, commas or line breaks stand in quotes, quotes are doubled, lines
// end in CR LF. That nothing and the empty text differ is ours.
TEST(Csv, QuotesWhatNeedsItAndKeepsEveryBit) {
  const Folder folder("csv");
  record::test::make_result(
      folder.path(),
      "INSERT INTO ends VALUES (1, 'a,b', 5, 'say \"hi\"'), (NULL, '', 6, 'two\r\nlines');"
      "INSERT INTO agents VALUES (1, 'm0', 'mote', 'p', 0.1, 1e-300, 2.0);");
  EXPECT_EQ(csv(folder.path(), "ends"),
            "agent,state,after_ns,result\r\n"
            "1,\"a,b\",5,\"say \"\"hi\"\"\"\r\n"
            ",\"\",6,\"two\r\nlines\"\r\n");
  EXPECT_EQ(csv(folder.path(), "agents"),
            "agent,name,kind,program,x_m,y_m,theta_rad\r\n1,m0,mote,p,0.1,1e-300,2\r\n");
  EXPECT_EQ(csv(folder.path(), "links"), "a,b\r\n");
}

// OWASP, "CSV Injection"; what a record has of numbers as text stays as it is.
TEST(Csv, ATextThatSpreadsheetsTakeForAFormulaIsMarked) {
  for (const char* text :
       {"=1+1", "+A1", "-2+3+cmd|' /C calc'!A0", "@SUM(A1)", "\tx", "-x", "-1 =1", "- A2"}) {
    EXPECT_EQ(csv_text(text).find_first_not_of('"'), csv_text(text).find('\'')) << text;
    EXPECT_NE(csv_text(text).find(text[0]), std::string::npos) << text;
  }
  for (const char* text : {"-85 dBm", "-0.5 - 0.31", "-", "+1.5e-3", "-9.81 m/s^2", "a=b", "m-1"}) {
    EXPECT_EQ(csv_text(text), text);
  }
  EXPECT_EQ(csv_text("=HYPERLINK(\"x\",1)"), "\"'=HYPERLINK(\"\"x\"\",1)\"");
  const Folder folder("formula");
  record::test::make_result(
      folder.path(), "INSERT INTO agents VALUES (1, '=1+1', 'mote', '-85 dBm', -0.5, -2, 0);");
  EXPECT_EQ(csv(folder.path(), "agents"),
            "agent,name,kind,program,x_m,y_m,theta_rad\r\n1,'=1+1,mote,-85 dBm,-0.5,-2,0\r\n");
}

TEST(Csv, ComesInTheOrderOfThePrimaryKey) {
  const Folder folder("order");
  record::test::make_result(
      folder.path(),
      "INSERT INTO agents VALUES (1, 'm0', 'mote', 'p', 0, 0, 0), (2, 'm1', 'mote', 'p', 0, "
      "0, 0); INSERT INTO poses VALUES (2,1,0,0,0), (1,9,0,0,0), (1,3,0,0,0)");
  EXPECT_EQ(csv(folder.path(), "poses"),
            "agent,at_ns,x_m,y_m,theta_rad\r\n1,3,0,0,0\r\n1,9,0,0,0\r\n2,1,0,0,0\r\n");
}

std::string error_of(const std::filesystem::path& folder, std::string_view table) {
  try {
    csv(folder, table);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "none";
}

TEST(Csv, AnotherTableOrVersionIsNamed) {
  const Folder folder("names");
  record::test::make_result(folder.path(), "PRAGMA user_version = 3");
  EXPECT_EQ(error_of(folder.path(), "pose").substr(0, 60),
            "'pose' is not a table of a result; there are: run, settings,");
  const std::string error = error_of(folder.path(), "poses");
  EXPECT_NE(error.find("version 3"), std::string::npos) << error;
  EXPECT_NE(error.find("version " + std::to_string(record::kSchemaVersion) + " only"),
            std::string::npos)
      << error;
}

}  // namespace
}  // namespace results::report::test
