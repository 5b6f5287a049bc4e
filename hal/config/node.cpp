#include "hal/config/node.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace hal::config {
namespace {

bool is_mapping(const Node& node) { return node.kind == Node::Kind::kMapping; }

Node decided(Node below, Node own) {
  const bool own_counts = own.place.layer >= below.place.layer;
  Node& winner = own_counts ? own : below;
  if (is_mapping(below) && is_mapping(own) && !winner.whole) {
    return merged(std::move(below), std::move(own));
  }
  return std::move(winner);
}

}  // namespace

std::string Place::text() const {
  return line == 0 ? file : fmt::format("{}:{}:{}", file, line, column);
}

const Entry* Node::find(const std::string& key) const {
  const auto found = std::find_if(entries.begin(), entries.end(),
                                  [&key](const Entry& entry) { return entry.key == key; });
  return found == entries.end() ? nullptr : &*found;
}

Entry* Node::find(const std::string& key) {
  return const_cast<Entry*>(std::as_const(*this).find(key));
}

std::string kind_name(const Node& node) {
  switch (node.kind) {
    case Node::Kind::kMapping:
      return "a mapping";
    case Node::Kind::kList:
      return fmt::format("a list of {}", node.items.size());
    case Node::Kind::kScalar:
      return fmt::format("'{}'", node.text);
    case Node::Kind::kNull:
      break;
  }
  return "nothing";
}

Node merged(Node below, Node own) {
  // A mapping that the command line only reaches into still stands where the file has it.
  if (own.place.layer == Layer::kFile) below.place = own.place;
  for (Entry& entry : own.entries) {
    Entry* lower = below.find(entry.key);
    if (lower == nullptr) {
      below.entries.push_back(std::move(entry));
      continue;
    }
    if (entry.value.place.layer >= lower->value.place.layer) lower->place = entry.place;
    lower->value = decided(std::move(lower->value), std::move(entry.value));
  }
  return below;
}

}  // namespace hal::config
