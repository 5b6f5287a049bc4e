#include "hal/files/config/writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "hal/files/config/value.h"
#include "hal/types/check.h"

namespace hal::files::config {
namespace {

/// Characters without special meaning anywhere in a plain scalar of YAML.
bool is_plain(char c) {
  const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  return letter || (c >= '0' && c <= '9') || c == '_' || c == '/' || c == '.';
}

bool may_stay_plain(std::string_view text) {
  if (text == "null" || text == "Null" || text == "NULL") return false;  // these mean nothing
  if (text.empty() || !is_plain(text.front()) || !is_plain(text.back())) return false;
  return std::all_of(text.begin(), text.end(),
                     [](char c) { return is_plain(c) || c == ' ' || c == '-' || c == '^'; });
}

/// Plain if YAML reads it back unchanged, otherwise in double quotes.
std::string scalar(std::string_view text) {
  if (may_stay_plain(text)) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      quoted += fmt::format("\\x{:02x}", static_cast<unsigned>(c));
    } else {
      quoted += c;
    }
  }
  return quoted + "\"";
}

}  // namespace

std::string format_duration(Duration value) {
  struct Scale {
    std::int64_t ns;
    std::string_view unit;
  };
  constexpr std::array kScales = {Scale{1'000'000'000, "s"}, Scale{1'000'000, "ms"},
                                  Scale{1'000, "us"}};
  for (const Scale& scale : kScales) {
    if (value.count() % scale.ns == 0) {
      return fmt::format("{} {}", value.count() / scale.ns, scale.unit);
    }
  }
  return fmt::format("{} ns", value.count());
}

std::string Writer::indent() {
  // Items of a list are indented one level below its key, and their keys one level more.
  const std::size_t depth = open_.size() - (starts_item_ ? 1 : 0);
  std::string spaces(2 * depth, ' ');
  if (std::exchange(starts_item_, false)) spaces += "- ";
  return spaces;
}

void Writer::line(std::string_view key, std::string_view value) {
  out_ += indent();
  out_ += scalar(key);
  out_ += ": ";
  out_ += value;
  out_ += '\n';
  values_.emplace_back(path() + std::string(key), value);
  empty_ = false;
}

void Writer::number(std::string_view key, double value, std::string_view unit) {
  line(key, format_value(value, unit));
}

void Writer::integer(std::string_view key, std::int64_t value) {
  line(key, fmt::format("{}", value));
}

void Writer::duration(std::string_view key, Duration value) { line(key, format_duration(value)); }

void Writer::flag(std::string_view key, bool value) { line(key, value ? "true" : "false"); }

void Writer::text(std::string_view key, std::string_view value) { line(key, scalar(value)); }

void Writer::numbers(std::string_view key, const std::vector<double>& values,
                     std::string_view unit) {
  std::vector<std::string> texts;
  texts.reserve(values.size());
  for (const double value : values) texts.push_back(format_value(value, unit));
  line(key, fmt::format("[{}]", fmt::join(texts, ", ")));
}

void Writer::texts(std::string_view key, const std::vector<std::string>& values) {
  std::vector<std::string> scalars;
  scalars.reserve(values.size());
  for (const std::string& value : values) scalars.push_back(scalar(value));
  line(key, fmt::format("[{}]", fmt::join(scalars, ", ")));
}

void Writer::open(std::string_view key, Kind kind) {
  out_ += indent() + scalar(key) + ":\n";
  open_.push_back({kind, path() + std::string(key) + "."});
  empty_ = true;
}

void Writer::open(std::string_view key) { open(key, Kind::kMapping); }
void Writer::open_list(std::string_view key) { open(key, Kind::kList); }

void Writer::open_item() {
  BARAKA_CHECK(!open_.empty() && open_.back().kind == Kind::kList);
  const int number = open_.back().items++;
  open_.push_back({Kind::kItem, fmt::format("{}{}.", path(), number)});
  starts_item_ = true;
  empty_ = false;
}

void Writer::close() {
  BARAKA_CHECK(!open_.empty());
  BARAKA_CHECK(!starts_item_);  // An item without keys would not be written.
  const Level level = open_.back();
  open_.pop_back();
  if (std::exchange(empty_, false) && level.kind != Kind::kItem) {
    out_.pop_back();  // the line break after the colon
    const std::string_view nothing = level.kind == Kind::kList ? "[]" : "{}";
    out_ += fmt::format(" {}\n", nothing);
    values_.emplace_back(level.path.substr(0, level.path.size() - 1), nothing);
  }
}

std::string Writer::take() {
  BARAKA_CHECK(open_.empty());
  return std::exchange(out_, {});
}

}  // namespace hal::files::config
