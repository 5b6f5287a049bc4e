#include "programs/models/yaml_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "hal/files/config/value.h"
#include "hal/types/printable.h"

namespace programs::models {

std::string value(double number, std::string_view unit) {
  return hal::files::config::format_value(number + 0.0, unit);  // -0 becomes 0
}

std::string list(std::initializer_list<double> numbers, std::string_view unit) {
  std::string text;
  for (const double one : numbers) text += (text.empty() ? "" : ", ") + value(one, unit);
  return "[" + text + "]";
}
std::string list(const Eigen::Vector2d& v, std::string_view unit) {
  return list({v.x(), v.y()}, unit);
}
std::string list(const Eigen::Vector3d& v, std::string_view unit) {
  return list({v.x(), v.y(), v.z()}, unit);
}

std::string at_line(Line line) { return line > 0 ? fmt::format("  # line {}\n", line) : "\n"; }

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : hal::printable(text)) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

std::string header(const std::string& file, std::vector<Note> notes) {
  std::string text = fmt::format("# from {}\n", hal::printable(file));
  std::ranges::stable_sort(notes, {}, &Note::line);
  for (const Note& note : notes)
    text += fmt::format("# left out: line {}: {}\n", note.line, hal::printable(note.what));
  return text;
}

std::string plain_name(const std::string& name, const std::string& kind) {
  std::string own;
  for (const char c : name) own += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  const bool begins_well =
      !own.empty() && std::isalpha(static_cast<unsigned char>(own.front())) != 0;
  return begins_well ? own : kind + own;
}

std::string name_of_its_own(const std::string& name, std::set<std::string>& taken) {
  std::string own = name;
  for (int i = 2; !taken.insert(own).second; ++i) own = fmt::format("{}_{}", name, i);
  return own;
}

Flow& Flow::add(std::string_view key, const std::string& text) {
  text_ += fmt::format("{}{}: {}", text_.empty() ? "" : ", ", key, text);
  return *this;
}

Flow& Flow::add(std::string_view key, const std::optional<double>& number, std::string_view unit) {
  return number ? add(key, value(*number, unit)) : *this;
}

}  // namespace programs::models
