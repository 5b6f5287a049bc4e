#include "sim/scenario/csv_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <fstream>

namespace sim::scenario {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSpaces = " \t\r";
constexpr std::uintmax_t kMostCsvBytes = 4U << 20U;

/// @param place  "file:line", or "row 7" of a key. @param has_columns  whether the column of a
/// cell is appended.
std::vector<CsvCell> csv_cells(std::string_view line, const std::string& place, bool has_columns) {
  std::vector<CsvCell> cells;
  std::size_t begin = 0;
  while (true) {
    const std::size_t comma = std::min(line.find(',', begin), line.size());
    std::size_t from = begin, to = comma;
    while (from < to && kSpaces.find(line[from]) != std::string_view::npos) ++from;
    while (to > from && kSpaces.find(line[to - 1]) != std::string_view::npos) --to;
    cells.push_back({std::string(line.substr(from, to - from)),
                     has_columns ? fmt::format("{}:{}", place, from + 1) : place});
    if (comma == line.size()) return cells;
    begin = comma + 1;
  }
}

/// Adds a row if it has a cell for each column.
void add_row(CsvTable& table, std::vector<CsvCell> cells, const std::string& key, Mapping& in) {
  if (cells.size() == table.header.size()) return table.rows.push_back(std::move(cells));
  in.mistake(key, fmt::format("{}: has {} values; needed are {}", cells.front().place, cells.size(),
                              fmt::join(table.header, ",")));
}

std::vector<std::string> texts_of(const std::vector<CsvCell>& cells) {
  std::vector<std::string> texts;
  texts.reserve(cells.size());
  for (const CsvCell& cell : cells) texts.push_back(cell.text);
  return texts;
}

}  // namespace

CsvTable read_csv(const fs::path& file, const std::string& key, Mapping& in) {
  CsvTable table;
  std::error_code error;
  const auto bytes = fs::file_size(file, error);
  if (error || bytes > kMostCsvBytes) {
    in.mistake(key, error
                        ? fmt::format("'{}' is not a file", file.string())
                        : fmt::format("'{}' has more than {} bytes", file.string(), kMostCsvBytes));
    return table;
  }
  std::ifstream stream(file);
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    const std::size_t first = line.find_first_not_of(kSpaces);
    if (first == std::string::npos || line[first] == '#') continue;
    auto cells = csv_cells(line, fmt::format("{}:{}", file.string(), number), true);
    if (table.header.empty())
      table.header = texts_of(cells);
    else
      add_row(table, std::move(cells), key, in);
  }
  if (table.rows.empty()) in.mistake(key, fmt::format("'{}' has no rows", file.string()));
  return table;
}

CsvTable csv_of(const Key& key, std::string_view header, Mapping& in) {
  CsvTable table{.header = texts_of(csv_cells(header, {}, false)), .rows = {}};
  int number = 0;
  for (const auto& text : in.texts(key)) {
    const std::string place = fmt::format("row {}", ++number);
    add_row(table, csv_cells(text.text, place, false), std::string(key.name), in);
  }
  return table;
}

std::optional<double> csv_number(const CsvCell& cell, std::string_view column, Range range,
                                 const std::string& key, Mapping& in) {
  double value = 0;
  const char* const end = cell.text.data() + cell.text.size();
  const auto [last, error] = std::from_chars(cell.text.data(), end, value);
  if (error == std::errc{} && last == end && value >= range.low && value <= range.high)
    return value;
  in.mistake(key, fmt::format("{}: {}: '{}' is not a number from {} to {}", cell.place, column,
                              cell.text, range.low, range.high));
  return std::nullopt;
}

}  // namespace sim::scenario
