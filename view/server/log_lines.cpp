#include "view/server/log_lines.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>

#include "view/server/tiles.h"

namespace view::server {
namespace {

constexpr const char* kLogFile = "run.log";
constexpr std::int64_t kLongestEntry = 8192;  // bytes of an entry that are shown

/// The time of a line "[  12.345000000] info r0: text"; none if it continues the line before.
std::optional<std::int64_t> time_of(std::string_view line) {
  constexpr std::size_t kDecimals = 9;
  const std::size_t dot = line.find('.');
  if (!line.starts_with('[') || dot == std::string_view::npos) return std::nullopt;
  const std::size_t digit = line.find_first_not_of(' ', 1);
  std::int64_t seconds = 0, ns = 0;
  const char* const text = line.data();
  const auto whole = std::from_chars(text + digit, text + dot, seconds);
  if (whole.ec != std::errc{} || whole.ptr != text + dot) return std::nullopt;
  if (line.size() < dot + kDecimals + 2 || line[dot + kDecimals + 1] != ']') return std::nullopt;
  const auto part = std::from_chars(text + dot + 1, text + dot + 1 + kDecimals, ns);
  if (part.ec != std::errc{} || part.ptr != text + dot + 1 + kDecimals) return std::nullopt;
  constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
  if (seconds < 0 || seconds > INT64_MAX / kNanosecondsPerSecond - 1) return std::nullopt;
  return seconds * kNanosecondsPerSecond + ns;
}

/// Removes and returns the text before a separator, and removes the separator; the whole text if
/// there is no separator.
std::string_view take_until(std::string_view& text, std::string_view separator) {
  const std::size_t end = std::min(text.find(separator), text.size());
  const std::string_view taken = text.substr(0, end);
  text.remove_prefix(std::min(end + separator.size(), text.size()));
  return taken;
}

void add_entry(Columns& columns, std::int64_t at, std::string_view entry) {
  take_until(entry, "] ");
  const std::string_view level = take_until(entry, " ");
  const std::string_view source = take_until(entry, ": ");
  columns.add(at, level, source, entry);
}

}  // namespace

void LogLines::read(const Record& record) {
  std::ifstream file(record.folder() / kLogFile, std::ios::binary);
  file.seekg(0, std::ios::end);
  if (!file || file.tellg() < read_) {  // the file is that of another run
    lines_.clear();
    read_ = 0;
  }
  if (!file) return;
  file.seekg(read_);
  std::string line;
  while (std::getline(file, line) && !file.eof()) {  // an unfinished line is read the next time
    const auto size = static_cast<std::int64_t>(line.size());
    if (const auto at = time_of(line)) {
      // Lines of several threads can be out of order.
      const std::int64_t before = lines_.empty() ? 0 : lines_.back().at;
      lines_.push_back({std::max(*at, before), read_, size});
    } else if (!lines_.empty()) {
      lines_.back().size = read_ + size - lines_.back().begin;
    }
    read_ += size + 1;
  }
}

std::string LogLines::tile(const Record& record, const Span& span) {
  read(record);
  const auto at = [](const Line& line) { return line.at; };
  const auto begin = std::ranges::lower_bound(lines_, span.from(), {}, at);
  const auto end = std::ranges::lower_bound(lines_, span.to(), {}, at);
  Columns columns({"at", "level", "source", "text"});
  if (end - begin > kMostRows) {
    Counts counts{};
    for (auto line = begin; line != end; ++line) ++counts.at(bin_of(span, line->at));
    return tile_text(record, span, false, columns, {{"bins", bins_json(counts)}});
  }
  std::ifstream file(record.folder() / kLogFile, std::ios::binary);
  std::string entry;
  for (auto line = begin; line != end; ++line) {
    entry.resize(static_cast<std::size_t>(std::min(line->size, kLongestEntry)));
    file.seekg(line->begin);
    file.read(entry.data(), static_cast<std::streamsize>(entry.size()));
    if (file) add_entry(columns, line->at, entry);
  }
  return tile_text(record, span, true, columns);
}

}  // namespace view::server
