#include "results/report/text_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "hal/types/printable.h"

namespace results::report {
namespace {

using Row = std::vector<std::string>;

std::vector<std::size_t> widths_of(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths;
  for (const Row& row : rows) {
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  return widths;
}

std::string line_of(const Row& row, const std::vector<std::size_t>& widths) {
  std::string line;
  for (std::size_t i = 0; i < row.size(); ++i) {
    line += i == 0 ? fmt::format("{:<{}}", row[i], widths[i])
                   : fmt::format("  {:>{}}", row[i], widths[i]);
  }
  line.erase(line.find_last_not_of(' ') + 1);
  return line + '\n';
}

}  // namespace

void TextTable::add_row(std::vector<std::string> cells) {
  for (std::string& cell : cells) cell = hal::printable(cell);
  rows_.push_back(std::move(cells));
}

std::string TextTable::text() const {
  const std::vector<std::size_t> widths = widths_of(rows_);
  std::string text;
  for (const Row& row : rows_) text += line_of(row, widths);
  return text;
}

}  // namespace results::report
