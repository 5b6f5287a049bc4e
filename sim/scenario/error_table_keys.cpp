#include "sim/scenario/error_table_keys.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "hal/files/config/suggest.h"

namespace sim::scenario {
namespace {

namespace fs = std::filesystem;
using radio::ErrorRow;

constexpr std::size_t kColumns = 4;
constexpr std::string_view kHeader = "mode,size,snr_db,per";
constexpr std::string_view kBlank = " \t\r";
constexpr std::uintmax_t kMostBytes = 8U << 20U;
constexpr double kMostDecibels = 100;
constexpr std::uint32_t kMostSize = 1'000'000;  // bytes

/// A row as written, and where, for messages: "table.csv:7".
struct Line {
  std::string place;
  std::string text;
};

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) + 1 - first);
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  while (true) {
    const std::size_t comma = line.find(',');
    cells.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

/// nullopt: not a number from `low` to `high`.
template <class Number>
std::optional<Number> number_in(std::string_view text, Number low, Number high) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = error == std::errc{} && end == text.data() + text.size();
  if (!is_number || !(value >= low && value <= high)) return std::nullopt;
  return value;
}

std::string unknown_mode(std::string_view name) {
  std::vector<std::string> names;
  for (const radio::NamedMode& one : radio::modes_with_error_tables()) names.push_back(one.name);
  std::string hint = hal::files::config::suggestion(name, names);
  if (hint.empty()) hint = fmt::format("; known: {}", fmt::join(names, ", "));
  return fmt::format("mode: '{}' is unknown{}", name, hint);
}

/// The row, or what is wrong with it.
std::variant<ErrorRow, std::string> row_of(std::string_view text) {
  const std::vector<std::string_view> cells = cells_of(text);
  if (cells.size() != kColumns) {
    return fmt::format("has {} values; needed are {}", cells.size(), kHeader);
  }
  const auto& modes = radio::modes_with_error_tables();
  const auto mode = std::ranges::find(modes, cells[0], &radio::NamedMode::name);
  if (mode == modes.end()) return unknown_mode(cells[0]);
  const auto size = number_in<std::uint32_t>(cells[1], 1, kMostSize);
  if (!size) return fmt::format("size: '{}' is not a number from 1 to {}", cells[1], kMostSize);
  const auto snr = number_in<double>(cells[2], -kMostDecibels, kMostDecibels);
  if (!snr) {
    return fmt::format("snr_db: '{}' is not a number from -{} to {}", cells[2], kMostDecibels,
                       kMostDecibels);
  }
  const auto per = number_in<double>(cells[3], 0, 1);
  if (!per) return fmt::format("per: '{}' is not a number from 0 to 1", cells[3]);
  return ErrorRow{mode->modulation, mode->mcs, *size, *snr, *per};
}

std::string text_of(const ErrorRow& row) {
  return fmt::format("{},{},{},{}", name_of_mode(row), row.size, row.snr_db, row.per);
}

/// Gets the rows and notes their mistakes.
radio::ErrorTable table_of(const std::vector<Line>& lines, const Key& key, Mapping& in) {
  radio::ErrorTable table;
  std::vector<std::string> places;
  bool is_right = true;
  const auto note = [&](const std::string& place, const std::string& what) {
    in.mistake(key.name, fmt::format("{}: {}", place, what));
    is_right = false;
  };
  for (const auto& [place, text] : lines) {
    const auto row = row_of(text);
    if (const auto* const what = std::get_if<std::string>(&row)) {
      note(place, *what);
      continue;
    }
    table.push_back(std::get<ErrorRow>(row));
    places.push_back(place);
  }
  for (const auto& [row, what] : wrong_rows(table)) note(places[row], what);
  return is_right ? table : radio::ErrorTable{};
}

/// The folder of the file in which a value stands; empty on the command line.
fs::path folder_of_table(const std::string& place) {
  const std::size_t column = place.rfind(':');
  if (column == std::string::npos) return {};
  const std::size_t line = place.rfind(':', column - 1);
  const fs::path file = place.substr(0, line);
  std::error_code error;
  const fs::path real = fs::canonical(file, error);
  return error ? file.parent_path() : real.parent_path();
}

/// The lines of a file after its header, without comments. Notes why there are none.
std::vector<Line> lines_of(const fs::path& file, const Key& key, Mapping& in) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) {
    in.mistake(key.name, fmt::format("there is no file '{}'", file.string()));
    return {};
  }
  if (const auto bytes = fs::file_size(file, error); error || bytes > kMostBytes) {
    in.mistake(key.name, fmt::format("'{}' has more than {} bytes", file.string(), kMostBytes));
    return {};
  }
  std::vector<Line> lines;
  std::ifstream stream(file);
  bool has_header = false;
  int number = 0;
  for (std::string text; std::getline(stream, text);) {
    ++number;
    const std::string_view line = trimmed(text);
    if (line.empty() || line.starts_with('#')) continue;
    if (!std::exchange(has_header, true)) {
      if (line == kHeader) continue;
      in.mistake(key.name, fmt::format("{}:{}: '{}' is not the header, {}", file.string(), number,
                                       line, kHeader));
      return {};
    }
    lines.push_back({fmt::format("{}:{}", file.string(), number), std::string(line)});
  }
  if (lines.empty()) in.mistake(key.name, fmt::format("'{}' has no rows", file.string()));
  return lines;
}

void read(Mapping& in, const Key& key, radio::ErrorTable& table) {
  if (!in.has(key.name)) return;
  std::vector<Line> lines;
  if (in.has_scalar(key.name)) {
    const fs::path file = folder_of_table(in.place(key.name)) / in.text(key);
    lines = lines_of(file.lexically_normal(), key, in);
  } else {
    int number = 0;
    for (const auto& row : in.texts(key)) {
      lines.push_back({fmt::format("row {}", ++number), row.text});
    }
  }
  table = table_of(lines, key, in);
}

}  // namespace

void error_table_key(Fields& io, radio::ErrorTable& table) {
  const Key key{
      "error_table",
      "Packet error rates by mode, size and SNR, which replace the formula for the modes that it "
      "has: rows of mode,size,snr_db,per; or the name of a CSV file with these as its header. "
      "Modes "
      "are OFDM6 to OFDM54, HT0 to HT7, VHT0 to VHT9 and HE0 to HE11, sizes bytes. The path is "
      "relative to the file in which it stands, on the command line to the working directory.",
      "['OFDM54,500,18,0.9', 'OFDM54,500,22,0.01']", "the formula for all modes"};
  io.written_if(!table.empty(), [&](Fields& given) {
    given.own(
        key, {.kind = hal::files::config::Form::Kind::kTexts},
        [&](Mapping& in) { read(in, key, table); },
        [&](Writer& out) {
          std::vector<std::string> rows;
          rows.reserve(table.size());
          for (const ErrorRow& row : table) rows.push_back(text_of(row));
          out.texts(key.name, rows);
        });
  });
}

}  // namespace sim::scenario
