#include "sim/report/csv.h"

#include <fmt/format.h>

#include <stdexcept>
#include <string>

#include "sim/record/run_reader.h"

namespace sim::report {
namespace {

using record::Column;
using record::Statement;
using record::Table;

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
  const Table* const table = record::find_table(name);
  if (table == nullptr) {
    throw std::runtime_error(
        fmt::format("'{}' is no table of a result; there are: {}", name, record::table_names()));
  }
  record::RunReader reader(folder);
  std::string columns;
  for (const Column& column : table->columns) {
    columns += (columns.empty() ? "" : ",") + std::string(column.name);
  }
  const std::string order = table->primary_key.empty() ? "rowid" : std::string(table->primary_key);
  Statement query =
      reader.query(fmt::format("SELECT {} FROM {} ORDER BY {}", columns, name, order));
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

}  // namespace sim::report
