#include "results/capsule/slim_database.h"

#include <fmt/format.h>

#include <set>
#include <vector>

#include "results/record/database.h"

namespace results::capsule {
namespace {

using record::Database;
using record::Statement;

/// A name or text between quotes, as SQL writes them.
std::string quoted(const std::string& text, char quote) {
  std::string result(1, quote);
  for (const char c : text) result += c == quote ? std::string(2, quote) : std::string(1, c);
  return result + quote;
}

std::vector<std::string> tables_of(Database& database) {
  std::vector<std::string> names;
  Statement all(database,
                "SELECT name FROM sqlite_master WHERE type = 'table' AND name NOT LIKE 'sqlite_%' "
                "ORDER BY rowid");
  while (all.next()) names.push_back(all.text(0));
  return names;
}

}  // namespace

std::map<std::string, std::int64_t> copy_without_bulk(const std::filesystem::path& from,
                                                      const std::filesystem::path& to,
                                                      std::int64_t most_rows) {
  // A repetition needs every input from outside.
  static const std::set<std::string> kept{"arrivals"};
  {
    Database whole(from, Database::Mode::kRead);
    whole.execute("VACUUM INTO " + quoted(to.string(), '\''));
  }
  std::map<std::string, std::int64_t> emptied;
  Database slim(to, Database::Mode::kUpdate);
  for (const std::string& name : tables_of(slim)) {
    Statement count(slim, "SELECT COUNT(*) FROM " + quoted(name, '"'));
    count.next();
    if (count.integer(0) > most_rows && !kept.contains(name)) emptied[name] = count.integer(0);
  }
  for (const auto& [name, rows] : emptied) slim.execute("DELETE FROM " + quoted(name, '"'));
  slim.execute("VACUUM");
  return emptied;
}

}  // namespace results::capsule
