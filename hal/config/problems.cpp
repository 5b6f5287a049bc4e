#include "hal/config/problems.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace hal::config {
namespace {

auto position(const Problem& problem) {
  const Place& place = problem.place;
  return std::tie(place.order, place.file, place.line, place.column, problem.key, problem.what);
}

std::string line(const Problem& problem) {
  const std::string place = problem.place.text();
  const bool says_key = problem.key.empty() || place == "--set " + problem.key;
  if (says_key) return fmt::format("{}: {}", place, problem.what);
  return fmt::format("{}: {}: {}", place, problem.key, problem.what);
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
