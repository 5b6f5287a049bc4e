#include "results/record/database.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <vector>

#include "tests/unit/results/record/test_run.h"

namespace results::record::test {
namespace {

TEST(Database, GivesBackWhatWasWritten) {
  const Folder folder("values");
  Database database(folder.file(), Database::Mode::kCreate);
  database.execute("CREATE TABLE t (a, b, c, d)");
  Statement insert(database, "INSERT INTO t VALUES (?, ?, ?, ?)");
  insert.run(std::numeric_limits<std::int64_t>::min(), 0.1, "it's", std::optional<double>());
  insert.run(std::int64_t{2}, 1e-300, std::string(), std::optional<double>(4));
  Statement query(database, "SELECT * FROM t ORDER BY a");
  ASSERT_TRUE(query.next());
  EXPECT_EQ(query.integer(0), std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(query.real(1), 0.1);
  EXPECT_EQ(query.text(2), "it's");
  EXPECT_TRUE(query.is_null(3));
  ASSERT_TRUE(query.next());
  EXPECT_EQ(query.real(1), 1e-300);
  EXPECT_FALSE(query.is_null(3));
  EXPECT_FALSE(query.next());
}

TEST(Database, ErrorsNameTheFileAndTheReason) {
  const Folder folder("errors");
  Database database(folder.file(), Database::Mode::kCreate);
  try {
    database.execute("SELECT * FROM nowhere");
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find(folder.file().string()), std::string::npos);
    EXPECT_NE(std::string(e.what()).find("no such table: nowhere"), std::string::npos);
  }
  EXPECT_THROW(Statement(database, "SELEKT"), std::runtime_error);
}

TEST(Database, AMissingFileIsAnErrorWhenReading) {
  const Folder folder("missing");
  EXPECT_THROW(Database(folder.file(), Database::Mode::kRead), std::runtime_error);
}

TEST(Database, AWriterWaitsForAReaderAsLongAsItIsTold) {
  const Folder folder("busy");
  { Database(folder.file(), Database::Mode::kCreate).execute("CREATE TABLE t (a)"); }
  Database reader(folder.file(), Database::Mode::kRead);
  reader.execute("BEGIN; SELECT COUNT(*) FROM t");
  std::vector<double> asked;
  bool patient = false;
  Database writer(folder.file(), Database::Mode::kUpdate, [&](double waited_s) {
    asked.push_back(waited_s);
    if (patient && asked.size() == 3) reader.execute("COMMIT");
    return patient;
  });
  EXPECT_THROW(writer.execute("INSERT INTO t VALUES (1)"), std::runtime_error);
  EXPECT_EQ(asked, std::vector{0.0});
  asked.clear();
  patient = true;
  EXPECT_NO_THROW(writer.execute("INSERT INTO t VALUES (1)"));
  EXPECT_EQ(asked, (std::vector{0.0, 0.1, 0.2}));
  EXPECT_EQ(ask(folder.file(), "SELECT COUNT(*) FROM t"), "1");
}

TEST(Database, CreatingReplacesAnOlderFile) {
  const Folder folder("replace");
  { Database(folder.file(), Database::Mode::kCreate).execute("CREATE TABLE t (a)"); }
  Database database(folder.file(), Database::Mode::kCreate);
  EXPECT_NO_THROW(database.execute("CREATE TABLE t (a)"));
}

}  // namespace
}  // namespace results::record::test
