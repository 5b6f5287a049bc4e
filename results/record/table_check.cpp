#include "results/record/table_check.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string_view>

namespace results::record {
namespace {

/// Normalises SQL: removes comments outside of quotes and replaces white space by one space.
std::string normal(std::string_view sql) {
  std::string result;
  bool is_quoted = false;
  for (std::size_t i = 0; i < sql.size(); ++i) {
    if (sql[i] == '\'') is_quoted = !is_quoted;
    if (!is_quoted && sql.substr(i, 2) == "--") {
      i = std::min(sql.find('\n', i), sql.size() - 1);
    }
    const bool is_space = !is_quoted && (sql[i] == ' ' || sql[i] == '\n');
    if (!is_space) result += sql[i];
    if (is_space && !result.empty() && result.back() != ' ') result += ' ';
  }
  return result.substr(0, result.find_last_not_of(" ;") + 1);
}

}  // namespace

PreparedSql prepared(sqlite3* handle, const std::string& sql) {
  sqlite3_stmt* statement = nullptr;
  const int size = static_cast<int>(sql.size());
  sqlite3_prepare_v2(handle, sql.data(), size, &statement, nullptr);
  return {statement, &sqlite3_finalize};
}

std::string text_at(sqlite3_stmt* statement, int column) {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement, column));
  if (text == nullptr) return "";
  return {text, static_cast<std::size_t>(sqlite3_column_bytes(statement, column))};
}

void require_tables(sqlite3* handle, const std::string& file, const std::vector<Table>& tables) {
  std::map<std::string, std::string> there;
  const PreparedSql rows = prepared(
      handle, "SELECT name, sql FROM sqlite_schema WHERE type IN ('table', 'view') AND sql > ''");
  int result = SQLITE_ERROR;
  while (rows && (result = sqlite3_step(rows.get())) == SQLITE_ROW) {
    there[text_at(rows.get(), 0)] = text_at(rows.get(), 1);
  }
  if (result != SQLITE_DONE) {
    throw std::runtime_error(
        fmt::format("{}: its list of tables cannot be read: {}", file, sqlite3_errmsg(handle)));
  }
  for (const Table& table : tables) {
    const auto found = there.find(std::string(table.name));
    if (found == there.end()) {
      throw std::runtime_error(fmt::format("{}: has no table {}", file, table.name));
    }
    if (normal(found->second) == normal(schema_sql({table}))) continue;
    throw std::runtime_error(
        fmt::format("{}: table {} is not as baraka makes it: other columns, or another view", file,
                    table.name));
  }
}

}  // namespace results::record
