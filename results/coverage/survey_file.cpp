#include "results/coverage/survey_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <fstream>
#include <stdexcept>
#include <string_view>

#include "hal/files/config/errors.h"

namespace results::coverage {
namespace {

constexpr std::array<std::string_view, 5> kColumnNames{"x", "y", "access_point", "dbm", "z"};
enum Column : std::size_t { kX, kY, kAccessPoint, kDbm, kZ };
constexpr std::size_t kNeeded = 4;  // of them; z may be missing
constexpr std::string_view kBlank = " \t\r";
constexpr double kFarthest = 1e6;  // m

struct Cell {
  std::string_view text;
  std::size_t column;  ///< Of its first character, from 1.
};

std::vector<Cell> cells_in(std::string_view line) {
  std::vector<Cell> cells;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    std::size_t first = begin;
    while (first < end && kBlank.find(line[first]) != std::string_view::npos) ++first;
    std::size_t last = end;
    while (last > first && kBlank.find(line[last - 1]) != std::string_view::npos) --last;
    cells.push_back({line.substr(first, last - first), first + 1});
    begin = end + 1;
  }
  return cells;
}

/// Small letters, and an underscore for a blank.
std::string plain(std::string_view name) {
  std::string result(name);
  for (char& c : result) {
    c = c == ' ' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return result;
}

class Reader {
 public:
  explicit Reader(const std::filesystem::path& file) : name_(file.string()), in_(file) {
    if (!in_) throw std::runtime_error(fmt::format("{}: cannot be read", name_));
  }

  std::vector<SurveyRow> rows() {
    std::vector<SurveyRow> rows;
    for (std::string line; std::getline(in_, line);) {
      ++number_;
      const std::size_t first = line.find_first_not_of(kBlank);
      if (first == std::string::npos || line[first] == '#') continue;
      if (where_.empty()) {
        read_header(cells_in(line));
      } else {
        rows.push_back(row_of(cells_in(line)));
      }
      if (!mistakes_.empty() && rows.empty()) break;  // of the header
    }
    if (mistakes_.empty() && rows.empty()) note(1, "has no rows");
    if (!mistakes_.empty()) throw hal::files::config::ConfigErrors(mistakes_);
    return rows;
  }

 private:
  static constexpr std::size_t kMissing = static_cast<std::size_t>(-1);

  std::string place(std::size_t column) const {
    return fmt::format("{}:{}:{}", name_, std::max<std::size_t>(number_, 1), column);
  }
  void note(std::size_t column, const std::string& what) {
    mistakes_.push_back(fmt::format("{}: {}", place(column), what));
  }

  void read_header(const std::vector<Cell>& cells) {
    where_.assign(kColumnNames.size(), kMissing);
    columns_ = cells.size();
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const auto* const known = std::ranges::find(kColumnNames, plain(cells[i].text));
      if (known == kColumnNames.end()) continue;
      std::size_t& where = where_[static_cast<std::size_t>(known - kColumnNames.begin())];
      if (where != kMissing) note(cells[i].column, fmt::format("column '{}' twice", *known));
      where = i;
    }
    for (std::size_t i = 0; i < kNeeded; ++i) {
      if (where_[i] != kMissing) continue;
      note(1, fmt::format("the header has no column '{}'; needed are x, y, access_point and dbm, "
                          "and z if heights were measured",
                          kColumnNames.at(i)));
    }
  }

  double number(const std::vector<Cell>& cells, Column which, double low, double high) {
    const Cell& cell = cells[where_[which]];
    double value = 0;
    const char* const end = cell.text.data() + cell.text.size();
    const auto read = std::from_chars(cell.text.data(), end, value);
    if (read.ec != std::errc{} || read.ptr != end || !(value >= low && value <= high)) {
      note(cell.column, fmt::format("{}: '{}' is not a number from {:g} to {:g}",
                                    kColumnNames.at(which), cell.text, low, high));
    }
    return value;
  }

  SurveyRow row_of(const std::vector<Cell>& cells) {
    SurveyRow row;
    if (cells.size() != columns_) {
      note(1, fmt::format("has {} values, the header {}", cells.size(), columns_));
      return row;
    }
    row.x = number(cells, kX, -kFarthest, kFarthest);
    row.y = number(cells, kY, -kFarthest, kFarthest);
    row.dbm = number(cells, kDbm, -200, 50);
    if (where_[kZ] != kMissing) row.z = number(cells, kZ, -kFarthest, kFarthest);
    const Cell& name = cells[where_[kAccessPoint]];
    row.access_point = std::string(name.text);
    row.place = place(1);
    row.access_point_place = place(name.column);
    return row;
  }

  std::string name_;
  std::ifstream in_;
  std::size_t number_ = 0, columns_ = 0;
  std::vector<std::size_t> where_;  ///< Index of the cell of each of kColumnNames.
  std::vector<std::string> mistakes_;
};

}  // namespace

std::vector<SurveyRow> read_survey(const std::filesystem::path& file) {
  return Reader(file).rows();
}

}  // namespace results::coverage
