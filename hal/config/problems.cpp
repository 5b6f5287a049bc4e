#include "hal/config/problems.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "hal/config/document_limits.h"

namespace hal::config {
namespace {

auto position(const Problem& problem) {
  const Place& place = problem.place;
  return std::tie(place.order, place.file, place.line, place.column, problem.key, problem.what);
}

std::string whole_line(const Problem& problem) {
  const std::string place = problem.place.text();
  const bool says_key = problem.key.empty() || place == "--set " + problem.key;
  if (says_key) return fmt::format("{}: {}", place, problem.what);
  return fmt::format("{}: {}: {}", place, problem.key, problem.what);
}

/// Takes out the middle of what is longer than `most`.
void shorten(std::string& text, std::size_t most) {
  if (text.size() <= most) return;
  const std::string cut = fmt::format("...({} bytes)...", text.size());
  text.replace(most / 2, text.size() - most, cut);
}

/// For people and their terminals: no control characters, no word or line without end.
std::string line(const Problem& problem) {
  std::string result, word;
  const auto end_word = [&] {
    shorten(word, kLongestWord);
    result += word;
    word.clear();
  };
  for (const char c : whole_line(problem)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) {
      word += fmt::format("\\x{:02x}", byte);
    } else {
      word += c;
    }
    if (c == ' ') end_word();
  }
  end_word();
  shorten(result, kLongestMessage);
  return result;
}

}  // namespace

void Problems::add(std::vector<Problem> problems, const std::string& path) {
  for (Problem& problem : problems) {
    problem.key = joined(path, problem.key);
    found_.push_back(std::move(problem));
  }
}

std::vector<std::string> Problems::messages() const {
  std::vector<Problem> sorted = found_;
  std::sort(sorted.begin(), sorted.end(),
            [](const Problem& a, const Problem& b) { return position(a) < position(b); });
  std::vector<std::string> lines;
  lines.reserve(sorted.size());
  for (const Problem& problem : sorted) lines.push_back(line(problem));
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  if (lines.size() > kMostMessages) {
    const std::string rest = fmt::format("and {} more mistakes", lines.size() - kMostMessages);
    lines.resize(kMostMessages);
    lines.push_back(rest);
  }
  return lines;
}

const Node& Problems::empty_mapping(const Place& place) {
  Node& node = empty_.emplace_back();
  node.kind = Node::Kind::kMapping;
  node.place = place;
  return node;
}

std::string joined(const std::string& path, const std::string& key) {
  if (path.empty() || key.empty()) return path + key;
  return path + "." + key;
}

}  // namespace hal::config
