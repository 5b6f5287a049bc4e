#include "results/record/cell_check.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "results/record/table_check.h"

namespace results::record {
namespace {

constexpr std::int64_t kFirstGroup = 65534;  // group addresses: neighbours, everyone
constexpr std::size_t kAddresses = 65536;
constexpr int kLongestRow = 32 << 20;  // bytes, also of one text
constexpr std::size_t kShown = 60;     // characters of a value in a message

/// The value for a message: texts are quoted and shortened.
std::string shown(sqlite3_stmt* statement, int column) {
  switch (sqlite3_column_type(statement, column)) {
    case SQLITE_NULL:
      return "null";
    case SQLITE_BLOB:
      return fmt::format("a blob of {} bytes", sqlite3_column_bytes(statement, column));
    case SQLITE_TEXT: {
      std::string text = text_at(statement, column);
      if (text.size() <= kShown) return fmt::format("'{}'", text);
      return fmt::format("'{}...' of {} bytes", text.substr(0, kShown), text.size());
    }
    default:
      return text_at(statement, column);
  }
}

/// SQL expression that identifies the rows of a table in messages.
std::string row_sql(const Table& table) {
  if (table.primary_key.empty()) return "rowid";
  std::string sql;
  for (std::string_view rest = table.primary_key; !rest.empty();) {
    const std::size_t end = std::min(rest.find(", "), rest.size());
    sql += fmt::format("{}substr({}, 1, {})", sql.empty() ? "" : " || ', ' || ",
                       rest.substr(0, end), kShown);
    rest.remove_prefix(std::min(end + 2, rest.size()));
  }
  return sql;
}

/// "count" for "MAX(l.count)"; other names are returned as they are.
std::string_view name_behind(std::string_view result) {
  for (const std::string_view function : {"SUM(", "MIN(", "MAX("}) {
    if (!result.starts_with(function) || !result.ends_with(")")) continue;
    result = result.substr(function.size(), result.size() - function.size() - 1);
    return result.substr(result.find('.') + 1);
  }
  return result;
}

std::string tables_of(const ColumnsRead& reading) {
  std::set<std::string_view> names;
  for (const CellRule* rule : reading.columns) {
    if (rule->table->query.empty()) names.insert(rule->table->name);
  }
  if (names.empty()) return "tables";
  return fmt::format("table{} {}", names.size() == 1 ? "" : "s", fmt::join(names, ", "));
}

/// ", row 17" if the statement selects rowid, else "".
std::string row_of(sqlite3_stmt* statement) {
  for (int i = 0; i < sqlite3_column_count(statement); ++i) {
    const char* const name = sqlite3_column_name(statement, i);
    if (name != nullptr && std::string_view(name) == "rowid") {
      return ", row " + text_at(statement, i);
    }
  }
  return "";
}

/// Why a value cannot be read as the type `as`; "" if it can.
std::string_view wrong_type(int type, CellRule::Kind as) {
  if (type == SQLITE_BLOB) return "not a number, nor a text";
  if (type == SQLITE_NULL) return "";
  if (as == CellRule::Kind::kInteger && type != SQLITE_INTEGER) return "not a whole number";
  if (as == CellRule::Kind::kReal && type == SQLITE_TEXT) return "not a number";
  return "";
}

}  // namespace

CellCheck::CellCheck(sqlite3* handle, std::string file, const std::vector<Table>& tables)
    : handle_(handle), file_(std::move(file)) {
  // sqlite.org/security.html, "Untrusted SQLite Database Files".
  sqlite3_db_config(handle_, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  for (const int off : {SQLITE_DBCONFIG_TRUSTED_SCHEMA, SQLITE_DBCONFIG_ENABLE_TRIGGER}) {
    sqlite3_db_config(handle_, off, 0, nullptr);
  }
  sqlite3_limit(handle_, SQLITE_LIMIT_LENGTH, kLongestRow);
  sqlite3_exec(handle_, "PRAGMA query_only = ON; PRAGMA cell_size_check = ON", nullptr, nullptr,
               nullptr);
  require_tables(handle_, file_, tables);
  make_rules(tables);
  sqlite3_set_authorizer(handle_, &CellCheck::authorize, this);
}

void CellCheck::make_rules(const std::vector<Table>& tables) {
  std::size_t count = 0;
  for (const Table& table : tables) count += table.columns.size();
  rules_.reserve(count);
  derived_.reserve(count);
  std::set<std::string_view> ambiguous;
  for (const Table& table : tables) {
    for (const Column& column : table.columns) {
      const CellRule& rule = rules_.emplace_back(rule_of(table, column));
      by_place_[{table.name, column.name}] = &rule;
      const auto known = by_name_.find(column.name);
      if (known != by_name_.end()) {
        if (!is_alike(*known->second, rule)) ambiguous.insert(column.name);
        known->second->may_be_zero |= rule.may_be_zero;
        continue;
      }
      CellRule& derived = derived_.emplace_back(rule);
      derived.may_be_null = true;
      by_name_[column.name] = &derived;
    }
  }
  for (const std::string_view name : ambiguous) by_name_.erase(name);
}

CellCheck::~CellCheck() { sqlite3_set_authorizer(handle_, nullptr, nullptr); }

void CellCheck::learn(const std::vector<std::int64_t>& agents, std::int64_t end) {
  agents_.assign(kAddresses, false);
  for (const std::int64_t agent : agents) agents_.at(static_cast<std::size_t>(agent)) = true;
  for (auto* rules : {&rules_, &derived_}) {
    for (CellRule& rule : *rules) {
      if (rule.is_time) rule.most = std::min(rule.most, end);
    }
  }
}

// SQLite also calls it when it prepares a statement again because the tables have changed. SQLite
// defines the parameters. NOLINTNEXTLINE(readability-function-size)
int CellCheck::authorize(void* self, int action, const char* first, const char* second,
                         const char* /*database*/, const char* /*trigger*/) {
  auto& check = *static_cast<CellCheck*>(self);
  switch (action) {
    case SQLITE_READ:
      if (const CellRule* rule = check.rule_at(first, second)) check.collected_.push_back(rule);
      return SQLITE_OK;
    case SQLITE_SELECT:
    case SQLITE_RECURSIVE:
    case SQLITE_FUNCTION:
      return SQLITE_OK;
    case SQLITE_PRAGMA:
      return std::string_view(first) == "user_version" && second == nullptr ? SQLITE_OK
                                                                            : SQLITE_DENY;
    default:
      return SQLITE_DENY;
  }
}

const CellRule* CellCheck::rule_at(std::string_view table, std::string_view column) const {
  const auto found = by_place_.find({table, column});
  return found == by_place_.end() ? nullptr : found->second;
}

void CellCheck::begin() { collected_.clear(); }

/// For a computed value: the rule of the cells whose name it has, or whose sum, minimum or maximum
/// it is.
const CellRule* CellCheck::rule_of_result(sqlite3_stmt* statement, int column) const {
  const std::string_view name = sqlite3_column_name(statement, column);
  const auto known = by_name_.find(name_behind(name));
  if (known == by_name_.end()) return nullptr;
  return name.starts_with("SUM(") && !may_be_summed(*known->second) ? nullptr : known->second;
}

ColumnsRead CellCheck::take(sqlite3_stmt* statement) {
  ColumnsRead reading;
  std::ranges::sort(collected_);
  collected_.erase(std::unique(collected_.begin(), collected_.end()), collected_.end());
  reading.columns = std::exchange(collected_, {});
  const int count = sqlite3_column_count(statement);
  reading.results.reserve(static_cast<std::size_t>(count));
  reading.is_derived.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const char* const table = sqlite3_column_table_name(statement, i);
    const char* const origin = sqlite3_column_origin_name(statement, i);
    const CellRule* rule = table != nullptr && origin != nullptr ? rule_at(table, origin) : nullptr;
    reading.is_derived.push_back(rule == nullptr);
    reading.results.push_back(rule != nullptr ? rule : rule_of_result(statement, i));
  }
  return reading;
}

bool CellCheck::fits_integer(std::int64_t value, const CellRule& rule) const {
  if (value < rule.least || value > rule.most) return false;
  return !rule.is_agent || agents_.empty() || value >= kFirstGroup ||
         (value == 0 && rule.may_be_zero) || agents_[static_cast<std::size_t>(value)];
}

bool CellCheck::fits(sqlite3_stmt* statement, int column, const CellRule& rule) const {
  using Kind = CellRule::Kind;
  switch (sqlite3_column_type(statement, column)) {
    case SQLITE_NULL:
      return rule.may_be_null;
    case SQLITE_INTEGER:
      if (rule.kind == Kind::kInteger) {
        return fits_integer(sqlite3_column_int64(statement, column), rule);
      }
      if (rule.kind == Kind::kAny) return true;
      [[fallthrough]];
    case SQLITE_FLOAT: {
      const double value = sqlite3_column_double(statement, column);
      return (rule.kind == Kind::kReal || rule.kind == Kind::kAny) && value >= rule.lowest &&
             value <= rule.highest;
    }
    case SQLITE_TEXT: {
      if (rule.kind != Kind::kText && rule.kind != Kind::kAny) return false;
      const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement, column));
      const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement, column));
      return text != nullptr && size <= rule.longest &&
             (rule.words.empty() ||
              std::ranges::find(rule.words, std::string_view(text, size)) != rule.words.end());
    }
    default:
      return false;
  }
}

void CellCheck::look_closer(sqlite3_stmt* statement, int column, CellRule::Kind as,
                            const ColumnsRead& reading) const {
  const auto place = static_cast<std::size_t>(column);
  const CellRule* const rule = reading.results[place];
  if (rule != nullptr && !fits(statement, column, *rule)) {
    if (!reading.is_derived[place]) refuse_bad_row(*rule);
    // A null from an outer join does not come from a row.
    if (sqlite3_column_type(statement, column) == SQLITE_NULL) return;
    refuse(statement, column, reading, expected(*rule));
  }
  if (rule != nullptr && rule->kind != CellRule::Kind::kAny) return;
  const std::string_view wrong = wrong_type(sqlite3_column_type(statement, column), as);
  if (!wrong.empty()) refuse(statement, column, reading, wrong);
}

void CellCheck::refuse(sqlite3_stmt* statement, int column, const ColumnsRead& reading,
                       std::string_view why) const {
  // If a sum is wrong, one of its cells is: report that.
  if (reading.is_derived[static_cast<std::size_t>(column)]) refuse_bad_rows(reading);
  throw std::runtime_error(fmt::format("{}: {}{}: {} is {}, {}", file_, tables_of(reading),
                                       row_of(statement), sqlite3_column_name(statement, column),
                                       shown(statement, column), why));
}

void CellCheck::refuse_bad_rows(const ColumnsRead& reading) const {
  for (const CellRule* rule : reading.columns) {
    if (rule->table->query.empty()) refuse_bad_row(*rule);
  }
}

void CellCheck::refuse_bad_row(const CellRule& rule) const {
  const Table& table = *rule.table;
  const PreparedSql found =
      prepared(handle_, fmt::format("SELECT {}, {} FROM {} WHERE {} LIMIT 1", row_sql(table),
                                    rule.column->name, table.name, broken_sql(rule)));
  if (!found || sqlite3_step(found.get()) != SQLITE_ROW) return;
  throw std::runtime_error(fmt::format("{}: table {}, row {}: {} is {}, {}", file_, table.name,
                                       text_at(found.get(), 0), rule.column->name,
                                       shown(found.get(), 1), expected(rule)));
}

void CellCheck::fail(const ColumnsRead& reading) const {
  const std::string reason = sqlite3_errmsg(handle_);
  // If a sum overflows or a page is damaged, one of the cells may be the cause. If another process
  // has locked the file, no cell can be read.
  const int code = sqlite3_errcode(handle_);
  if (code == SQLITE_ERROR || code == SQLITE_CORRUPT || code == SQLITE_TOOBIG) {
    refuse_bad_rows(reading);
  }
  throw std::runtime_error(fmt::format("{}: {}: {}", file_, tables_of(reading), reason));
}

}  // namespace results::record
