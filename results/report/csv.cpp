#include "results/report/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <string>
#include <system_error>

#include "results/campaign/schema.h"
#include "results/record/run_reader.h"

namespace results::report {
namespace {

using record::Column;
using record::Statement;
using record::Table;

constexpr std::string_view kLineEnd = "\r\n";

/// Whether a word is a number, "-", or a unit such as "m/s^2".
bool is_harmless(std::string_view word) {
  if (word == "-") return true;
  double number = 0;
  const std::size_t sign = word.starts_with('+') ? 1 : 0;  // from_chars() accepts no plus sign
  const char* const end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data() + sign, end, number);
  if (error != std::errc::invalid_argument && rest == end) return true;
  // A unit has no digits except in a power: "A2" would be a cell of a spreadsheet.
  for (std::size_t i = 0; i < word.size(); ++i) {
    const char c = word[i];
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    const bool is_power = c == '2' && i > 0 && word[i - 1] == '^';
    if (!is_letter && !is_power && c != '/' && c != '^') return false;
  }
  return true;
}

bool may_be_formula(std::string_view text) {
  if (text.empty() || std::string_view("=+-@\t\r\n").find(text.front()) == std::string_view::npos) {
    return false;
  }
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    if (!is_harmless(text.substr(0, end))) return true;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return false;
}

std::string quoted(const std::string& text) {
  if (!text.empty() && text.find_first_of("\",\r\n") == std::string::npos) return text;
  std::string field = "\"";
  for (const char c : text) {
    if (c == '"') field += '"';
    field += c;
  }
  return field + '"';
}

std::string field_of(const Statement& query, int column) {
  if (query.is_null(column)) return "";
  if (query.is_real(column)) return fmt::format("{}", query.real(column));
  return csv_text(query.text(column));
}

using Write = std::function<void(std::string_view)>;

std::string columns_of(const Table& table) {
  std::string columns;
  for (const Column& column : table.columns) {
    columns += (columns.empty() ? "" : ",") + std::string(column.name);
  }
  return columns;
}

/// All rows, in the order of the primary key if there is one, otherwise as recorded.
std::string query_for(const Table& table) {
  const std::string order = table.primary_key.empty() ? "rowid" : std::string(table.primary_key);
  return fmt::format("SELECT {} FROM {} ORDER BY {}", columns_of(table), table.name, order);
}

void write_rows(Statement& query, const Table& table, const Write& write) {
  write(columns_of(table));
  write(kLineEnd);
  std::string line;
  while (query.next()) {
    line.clear();
    for (int i = 0; i < static_cast<int>(table.columns.size()); ++i) {
      if (i > 0) line += ',';
      line += field_of(query, i);
    }
    line += kLineEnd;
    write(line);
  }
}

}  // namespace

std::string csv_text(std::string_view text) {
  return quoted(may_be_formula(text) ? fmt::format("'{}", text) : std::string(text));
}

void write_csv(const std::filesystem::path& folder, std::string_view name, const Write& write) {
  const Table* const table = record::find_table(name);
  if (table == nullptr) {
    throw std::runtime_error(
        fmt::format("'{}' is not a table of a result; there are: {}", name, record::table_names()));
  }
  record::RunReader reader(folder);
  Statement query = reader.query(query_for(*table));
  write_rows(query, *table, write);
}

void write_csv(campaign::CampaignReader& reader, std::string_view name, const Write& write) {
  const Table* const table = record::find_table(campaign::tables(), name);
  if (table == nullptr) {
    throw std::runtime_error(fmt::format("'{}' is not a table of a campaign; there are: {}", name,
                                         record::table_names(campaign::tables())));
  }
  Statement query = reader.query(query_for(*table));
  write_rows(query, *table, write);
}

}  // namespace results::report
