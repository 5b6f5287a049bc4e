#include "results/record/schema.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include "results/record/description.h"
#include "tests/unit/results/record/test_run.h"

namespace results::record::test {
namespace {

/// What a name must end in to say its unit.
std::string suffix_of(std::string_view unit) {
  static const std::map<std::string_view, std::string> suffixes = {
      {"m", "_m"},     {"rad", "_rad"},   {"ns", "_ns"}, {"s", "_s"},   {"dBm", "_dbm"},
      {"bit", "bits"}, {"byte", "bytes"}, {"J", "_j"},   {"dB", "_db"}, {"bit/s", "_bps"},
      {"MHz", "_mhz"}, {"kg", "_kg"},     {"", ""}};
  return suffixes.at(unit);
}

TEST(Schema, EveryNameCarriesItsUnitAndEveryColumnSaysWhatItIs) {
  std::set<std::string_view> names;
  for (const Table& table : tables()) {
    EXPECT_TRUE(names.insert(table.name).second) << table.name;
    EXPECT_FALSE(table.meaning.empty()) << table.name;
    for (const Column& column : table.columns) {
      EXPECT_TRUE(column.name.ends_with(suffix_of(column.unit))) << table.name << column.name;
      EXPECT_FALSE(column.meaning.empty()) << table.name << "." << column.name;
      // No number with a decimal point is without a unit, but those whose unit stands beside them,
      // and the weights of routes, which are compared among themselves only, and quaternions.
      const bool has_unit = !column.unit.empty() || table.name == "recorded" ||
                            table.name.starts_with("observable_") || column.name == "weight" ||
                            table.name == "movable_poses";
      EXPECT_TRUE(has_unit || !column.type.starts_with("REAL")) << table.name << "." << column.name;
    }
  }
  for (const RunKey& key : run_keys()) {
    EXPECT_TRUE(key.name.ends_with(suffix_of(key.unit))) << key.name;
  }
}

TEST(Schema, SqliteHasTheTablesAsDescribed) {
  const Folder folder("tables");
  make_result(folder.path(), "");
  for (const Table& table : tables()) {
    Database database(folder.file(), Database::Mode::kRead);
    Statement query(database,
                    "SELECT name FROM pragma_table_info('" + std::string(table.name) + "')");
    for (const Column& column : table.columns) {
      ASSERT_TRUE(query.next()) << table.name << "." << column.name;
      EXPECT_EQ(query.text(0), column.name);
    }
    EXPECT_FALSE(query.next()) << table.name;
  }
  EXPECT_EQ(
      ask(folder.file(), "SELECT COUNT(*) FROM sqlite_master WHERE type IN ('table', 'view')"),
      std::to_string(tables().size()));
}

// If it fails: build/release/bin/baraka export --describe -o docs/results.md
TEST(Schema, ThePageOfTheResultsIsTheirDescription) {
  std::ifstream file(std::string(TESTS_DIR) + "/../docs/results.md");
  std::istringstream description(describe_results());
  std::string written, described;
  for (int line = 1; std::getline(description, described); ++line) {
    ASSERT_TRUE(std::getline(file, written)) << "docs/results.md ends at line " << line;
    ASSERT_EQ(written, described) << "docs/results.md:" << line;
  }
  EXPECT_FALSE(std::getline(file, written)) << written;
}

}  // namespace
}  // namespace results::record::test
