#include "sim/record/csv.h"

#include <fmt/format.h>

#include <stdexcept>
#include <string>

#include "sim/record/schema.h"

namespace sim::record {
namespace {

constexpr std::string_view kLineEnd = "\r\n";

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
  return quoted(query.text(column));
}

}  // namespace

void write_csv(const std::filesystem::path& folder, std::string_view name,
               const std::function<void(std::string_view)>& write) {
  const Table* const table = find_table(name);
  if (table == nullptr) {
    throw std::runtime_error(
        fmt::format("'{}' is no table of a result; there are: {}", name, table_names()));
  }
  Database database(folder / kResultsFile, Database::Mode::kRead);
  require_version(database, folder);
  std::string columns;
  for (const Column& column : table->columns) {
    columns += (columns.empty() ? "" : ",") + std::string(column.name);
  }
  const std::string order = table->primary_key.empty() ? "rowid" : std::string(table->primary_key);
  Statement query(database, fmt::format("SELECT {} FROM {} ORDER BY {}", columns, name, order));
  write(columns);
  write(kLineEnd);
  std::string line;
  while (query.next()) {
    line.clear();
    for (int i = 0; i < static_cast<int>(table->columns.size()); ++i) {
      if (i > 0) line += ',';
      line += field_of(query, i);
    }
    line += kLineEnd;
    write(line);
  }
}

}  // namespace sim::record
