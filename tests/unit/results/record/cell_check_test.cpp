#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>
#include <string>

#include "results/record/cell_rule.h"
#include "results/record/run_reader.h"
#include "results/record/scalars.h"
#include "tests/unit/results/record/test_run.h"

namespace results::record::test {
namespace {

constexpr const char* kAgent =
    "INSERT INTO agents VALUES (1, 'm0', 'mote', 'p', 0, 0, 0);"
    "INSERT INTO run VALUES ('ended_ns', 5000000000), ('simulated_s', 5.0);";

/// What reading does with a result by hand; "": nothing is wrong with it.
class Forged {
 public:
  Forged(const std::string& name, const std::string& sql) : folder_(name) {
    make_result(folder_.path(), kAgent + sql);
  }

  /// As nobody can who does not write into the file past SQLite: a null where there may be none.
  void without_constraints(const std::string& table, const std::string& sql) const {
    Database database(folder_.file(), Database::Mode::kUpdate);
    const std::string make = schema_sql({*find_table(table)});
    database.execute(
        "PRAGMA writable_schema = ON; UPDATE sqlite_schema SET sql = replace(sql,"
        " ' NOT NULL', '') WHERE name = '" +
        table + "'");
    Database again(folder_.file(), Database::Mode::kUpdate);
    again.execute(sql);
    again.execute("PRAGMA writable_schema = ON");
    Statement restore(again, "UPDATE sqlite_schema SET sql = ?1 WHERE name = ?2");
    restore.run(make.substr(0, make.rfind(';')), table);
  }

  std::string complaint(const std::string& sql) const {
    return complaint_of([&](RunReader& reader) {
      Statement rows = reader.query(sql);
      while (rows.next()) (void)rows.text(0);
    });
  }
  std::string complaint_of(const auto& read) const {
    try {
      RunReader reader(folder_.path());
      read(reader);
    } catch (const std::runtime_error& e) {
      std::string what = e.what();
      const std::size_t at = what.find(folder_.file().string());
      return at == 0 ? what.substr(folder_.file().string().size()) : "without the file: " + what;
    }
    return "";
  }
  std::string complaint() const {
    return complaint_of([](RunReader&) {});
  }
  const Folder& folder() const { return folder_; }

 private:
  Folder folder_;
};

TEST(CellCheck, TakesWhatARunCanHaveWritten) {
  const Forged forged("sound",
                      "INSERT INTO poses VALUES (1, 0, 0.5, -2, 3), (1, 5000000000, 1e6, 0, 0);"
                      "INSERT INTO frame_ends VALUES (1, 1, 7, 'delivered', -9e999, NULL);"
                      "INSERT INTO requests VALUES (1, 4711, 'transmitted', 3);");
  for (const char* column : {"agent", "at_ns", "x_m"}) {
    EXPECT_EQ(forged.complaint("SELECT " + std::string(column) + " FROM poses"), "");
  }
  EXPECT_EQ(forged.complaint("SELECT rssi_dbm FROM frame_ends"), "");
  EXPECT_EQ(forged.complaint("SELECT peer FROM requests"), "");
  EXPECT_EQ(forged.complaint("SELECT verdict FROM requests"), "");
}

TEST(CellCheck, NamesFileTableRowColumnAndValue) {
  const Forged forged("named",
                      "INSERT INTO queues VALUES (1, 0, 1), (1, 9e999, 2), (1, 1, 'many');"
                      "INSERT INTO states VALUES (1, -1, 'A'), (7, 0, 'A'), (1, 2, X'1b');"
                      "INSERT INTO contacts VALUES (1, 5000000001, 'wall');"
                      "INSERT INTO frames_sent VALUES (1, 65535, 'x', -1);"
                      "INSERT INTO bodies VALUES (1, 9e999, NULL, 0, 0, 0, 0, NULL, NULL);");
  EXPECT_EQ(
      forged.complaint("SELECT at_ns FROM queues"),
      ": table queues, row 2: at_ns is Inf, not a whole number from 0 to 5000000000, when the "
      "run ended");
  EXPECT_EQ(forged.complaint("SELECT frames FROM queues"),
            ": table queues, row 3: frames is 'many', not a whole number from 0 to "
            "9007199254740992");
  EXPECT_EQ(forged.complaint("SELECT at_ns FROM states"),
            ": table states, row 1: at_ns is -1, not a whole number from 0 to 5000000000, when the "
            "run ended");
  EXPECT_EQ(forged.complaint("SELECT agent FROM states"),
            ": table states, row 2: agent is 7, no agent of this run");
  EXPECT_EQ(forged.complaint("SELECT state FROM states"),
            ": table states, row 3: state is a blob of 1 bytes, not a text of up to 65536 bytes");
  EXPECT_EQ(
      forged.complaint("SELECT at_ns FROM contacts"),
      ": table contacts, row 1: at_ns is 5000000001, not a whole number from 0 to 5000000000, "
      "when the run ended");
  EXPECT_EQ(forged.complaint("SELECT class FROM frames_sent"),
            ": table frames_sent, row 1, 65535, x: class is 'x', not one of 'rts', 'cts', 'ack', "
            "'broadcast', 'unicast', 'beacon', 'management', 'block_ack'");
  EXPECT_EQ(forged.complaint("SELECT path_m FROM bodies"),
            ": table bodies, row 1: path_m is Inf, not a number from -1e+12 to 1e+12");
}

TEST(CellCheck, FindsTheCellBehindASum) {
  const Forged forged("sums",
                      "INSERT INTO frames_sent VALUES (1, 2, 'ack', 9223372036854775807),"
                      " (1, 3, 'ack', 9223372036854775807);"
                      "INSERT INTO packets VALUES (1, 2, 'unicast', -5);");
  const std::string row = ": table frames_sent, row 1, 2, ack: count is 9223372036854775807, ";
  EXPECT_TRUE(forged.complaint("SELECT SUM(count) FROM frames_sent").starts_with(row));
  EXPECT_EQ(forged.complaint("SELECT SUM(count) AS count FROM packets"),
            ": table packets, row 1, 2, unicast: count is -5, not a whole number from 0 to "
            "9007199254740992");
}

TEST(CellCheck, ANullIsRefusedWhereThereMayBeNoneButNotOfAnOuterJoin) {
  const Forged forged("nulls", "INSERT INTO states VALUES (1, 1, 'A'), (1, 2, 'B');");
  const char* const joined = "SELECT w.x_m FROM states s LEFT JOIN walls w ON w.name = s.state";
  EXPECT_EQ(forged.complaint(joined), "");
  forged.without_constraints("states", "UPDATE states SET at_ns = NULL WHERE state = 'B'");
  EXPECT_EQ(forged.complaint("SELECT at_ns FROM states"),
            ": table states, row 2: at_ns is null, not a whole number from 0 to 5000000000, when "
            "the run ended");
  EXPECT_EQ(forged.complaint(joined), "");
}

TEST(CellCheck, ValuesOfTheRunAreWhatTheirKeysSay) {
  const auto complaint = [](const char* name, const char* row) {
    return Forged(name, "INSERT OR REPLACE INTO run VALUES " + std::string(row)).complaint();
  };
  EXPECT_EQ(complaint("endless", "('simulated_s', 1e308)"),
            ": table run, row simulated_s: value is 1.0e+308, longer than a run can be");
  EXPECT_EQ(complaint("late", "('ended_ns', 9223372036854775807)"),
            ": table run, row ended_ns: value is 9223372036854775807, longer than a run can be");
  EXPECT_EQ(complaint("word", "('ended_ns', 'soon')"),
            ": table run, row ended_ns: value is 'soon', not a number");
  EXPECT_EQ(complaint("negative", "('events', -1)"),
            ": table run, row events: value is -1, negative");
  EXPECT_EQ(complaint("other", "('mine', 'soon')"), "");
}

TEST(CellCheck, TheTablesAreThoseOfTheVersion) {
  EXPECT_EQ(Forged("view",
                   "DROP VIEW verdict_sums; CREATE VIEW verdict_sums AS WITH RECURSIVE c(x) AS "
                   "(SELECT 1 UNION ALL SELECT x + 1 FROM c) SELECT 'ack' AS class, 1 AS addressed,"
                   " 'delivered' AS verdict, x AS count FROM c;")
                .complaint(),
            ": table verdict_sums is not as baraka makes it: other columns, or another view");
  EXPECT_EQ(
      Forged("computed", "ALTER TABLE walls ADD COLUMN more AS (zeroblob(100000000));").complaint(),
      ": table walls is not as baraka makes it: other columns, or another view");
  EXPECT_EQ(Forged("gone", "DROP TABLE walls;").complaint(), ": has no table walls");
  // What nobody reads does no harm.
  EXPECT_EQ(Forged("more", "CREATE TABLE mine (a); CREATE INDEX i ON states (at_ns);").complaint(),
            "");
}

TEST(CellCheck, StatementsOnlyRead) {
  const Forged forged("writes", "");
  for (const char* sql : {"DELETE FROM agents", "ATTACH 'elsewhere' AS e", "PRAGMA journal_mode",
                          "CREATE TEMP TABLE t (a)"}) {
    EXPECT_NE(forged.complaint(sql), "") << sql;
  }
  EXPECT_EQ(ask(forged.folder().file(), "SELECT COUNT(*) FROM agents"), "1");
}

// SQLite would read the file that such a journal names as a list, and remove it.
TEST(CellCheck, AJournalThatNamesAnotherFileIsRefused) {
  const Forged forged("journal", "");
  const std::string victim = (forged.folder().path() / "victim").string();
  std::ofstream(victim) << "precious";
  std::string journal("\xd9\xd5\x05\xf9\x20\xa1\x63\xd7\0\0\0\0", 12);
  journal.resize(512, '\0');
  const auto big_endian = [&](std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) journal += static_cast<char>(value >> shift);
  };
  big_endian(1 + 0x40000000 / 4096);
  journal += victim;
  std::uint32_t sum = 0;
  for (const char c : victim) sum += static_cast<std::uint32_t>(c);
  big_endian(static_cast<std::uint32_t>(victim.size()));
  big_endian(sum);
  journal += "\xd9\xd5\x05\xf9\x20\xa1\x63\xd7";
  std::ofstream(forged.folder().file().string() + "-journal", std::ios::binary) << journal;
  EXPECT_NE(forged.complaint().find("names another file: not left by baraka"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(victim));
}

TEST(CellCheck, SamplesAreInOrderOfTime) {
  const Forged forged("order",
                      "INSERT INTO observables VALUES (1, 'agents.x', 1, 'm', 'samples', NULL, 0);"
                      "INSERT INTO observable_samples VALUES (1, 2, 1), (1, 1, 1);");
  EXPECT_EQ(
      forged.complaint_of([](RunReader& reader) { (void)series_of(reader); }),
      ": tables agents, observable_samples, observables, row 2: at_ns is 1, before that of an "
      "earlier row");
}

// The sum of flags is a number of rows; that of counts cannot be below 0.
TEST(CellCheck, ASumIsAsItsCellsWhereSumsAreOfTheirKind) {
  const Forged forged("sum_rules",
                      "INSERT INTO discoveries VALUES (1, 'a', 2, 0, 1, 1), (1, 'a', 2, 0, 1, 1);"
                      "INSERT INTO packets VALUES (1, 2, 'unicast', -5);");
  EXPECT_EQ(forged.complaint("SELECT SUM(found) FROM discoveries"), "");
  EXPECT_EQ(forged.complaint("SELECT SUM(p.count) FROM packets p"),
            ": table packets, row 1, 2, unicast: count is -5, not a whole number from 0 to "
            "9007199254740992");
}

// So that a new table brings its rules along.
TEST(CellCheck, RulesFollowFromWhatTheTablesSayOfThemselves) {
  static const std::vector<Table> kTables{
      {"agents", "", {{"agent", "INTEGER PRIMARY KEY", "", "address"}}},
      {"losses",
       "",
       {{"sender", "INTEGER NOT NULL", "", "agent"},
        {"agent", "INTEGER NOT NULL", "", "where it was lost; 0: unknown"},
        {"verdict", "TEXT NOT NULL", "", "how; 'under way' at the end"}}}};
  const Folder folder("derived");
  {
    Database made(folder.file(), Database::Mode::kCreate);
    made.execute(schema_sql(kTables));
    made.execute(
        "INSERT INTO agents VALUES (3); INSERT INTO losses VALUES (3, 0, 'under way'),"
        " (3, 3, 'noise'), (0, 3, 'magic')");
  }
  Database database(folder.file(), Database::Mode::kRead);
  database.read_only_sound(kTables);
  database.know({3}, kLatestTime);
  const auto complaint = [&](const std::string& column) -> std::string {
    try {
      Statement rows(database, "SELECT " + column + " FROM losses");
      while (rows.next()) (void)rows.text(0);
    } catch (const std::runtime_error& e) {
      return std::string(e.what()).substr(folder.file().string().size());
    }
    return "";
  };
  EXPECT_EQ(complaint("agent"), "");
  EXPECT_EQ(complaint("MAX(agent)"), "");
  EXPECT_EQ(complaint("sender"), ": table losses, row 3: sender is 0, no agent of this run");
  EXPECT_TRUE(complaint("verdict").starts_with(
      ": table losses, row 3: verdict is 'magic', not one of 'delivered', "));
}

// A rule that refuses what its own table is made for would make every result unreadable.
TEST(CellCheck, EachColumnHasARangeThatIsNotEmpty) {
  for (const Table& table : tables()) {
    for (const Column& column : table.columns) {
      const CellRule rule = rule_of(table, column);
      EXPECT_LE(rule.least, rule.most) << table.name << "." << column.name;
      EXPECT_LT(rule.lowest, rule.highest) << table.name << "." << column.name;
      EXPECT_EQ(rule.kind == CellRule::Kind::kAny, column.type.empty())
          << table.name << "." << column.name;
    }
  }
}

}  // namespace
}  // namespace results::record::test
