#include "hal/files/config/problems.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>
#include <string_view>
#include <tuple>

namespace hal::files::config {
namespace {

auto position(const Problem& problem) {
  const Place& place = problem.place;
  return std::tie(place.order, place.file, place.line, place.column, problem.key, problem.what);
}

/// "--set a.0.b" without item indices, which keys of problems do not contain.
std::string without_numbers(const std::string& place) {
  std::string text;
  std::size_t begin = 0;
  for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
    end = place.find('.', begin);
    const std::string part = place.substr(begin, end == std::string::npos ? end : end - begin);
    const bool is_number = part.find_first_not_of("0123456789") == std::string::npos;
    if (!is_number) text += (text.empty() ? "" : ".") + part;
  }
  return text;
}

/// @param mark  between the place and the key: "" or "warning: ".
std::string line(const Problem& problem, std::string_view mark) {
  const std::string place = problem.place.text();
  const bool is_set = problem.place.line == 0;
  const bool says_key =
      problem.key.empty() || (is_set && without_numbers(place) == "--set " + problem.key);
  if (says_key) return fmt::format("{}: {}{}", place, mark, problem.what);
  return fmt::format("{}: {}{}: {}", place, mark, problem.key, problem.what);
}

}  // namespace

void Problems::add(std::vector<Problem> problems, const std::string& path) {
  for (Problem& problem : problems) {
    problem.key = joined(path, problem.key);
    found_.push_back(std::move(problem));
  }
}

std::vector<std::string> Problems::lines(std::vector<Problem> problems,
                                         std::string_view mark) const {
  std::ranges::stable_sort(problems, std::less<>{}, position);
  std::vector<std::string> lines;
  lines.reserve(problems.size());
  std::set<std::string> said;  // a file that several agents include is read several times
  for (const Problem& problem : problems) {
    std::string text = line(problem, mark) + includers(problem.place);
    if (said.insert(text).second) lines.push_back(std::move(text));
  }
  return lines;
}

/// " (included by a.yaml:5:10, that by b.yaml:2:3)"; empty for the first file.
std::string Problems::includers(const Place& place) const {
  std::string text;
  for (auto by = included_by_.find(place.order); by != included_by_.end();
       by = included_by_.find(by->second.order)) {
    text += (text.empty() ? " (included by " : ", that by ") + by->second.text();
  }
  return text.empty() ? text : text + ")";
}

std::vector<std::string> Problems::messages() const { return lines(found_, ""); }

std::vector<std::string> Problems::warnings() const { return lines(warnings_, "warning: "); }

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

}  // namespace hal::files::config
