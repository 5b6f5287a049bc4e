#include "hal/files/config/node.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <system_error>
#include <utility>

#include "hal/files/config/list_edit.h"

namespace hal::files::config {
namespace {

bool is_mapping(const Node& node) { return node.kind == Node::Kind::kMapping; }

Node decided(Node below, Node own);

/// Index of the list item that a key of the command line denotes: "0", "1", …
std::optional<std::size_t> index_of(const std::string& key, std::size_t items) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), index);
  const bool is_number = error == std::errc{} && end == key.data() + key.size();
  return is_number && index < items ? std::optional(index) : std::nullopt;
}

/// A list in which the command line sets items, or values inside them. Keys that denote no item are
/// kept in the list as entries, for the Loader to refuse.
Node with_items_set(Node list, Node own) {
  Node edit;
  for (Entry& entry : own.entries) {
    if (entry.key == "add" || entry.key == "remove") {
      edit.entries.push_back(std::move(entry));
    } else if (const auto index = index_of(entry.key, list.items.size())) {
      Node& item = list.items[*index];
      item = decided(std::move(item), std::move(entry.value));
    } else {
      list.entries.push_back(std::move(entry));
    }
  }
  return edited(std::move(list), std::move(edit));
}

Node decided(Node below, Node own) {
  if (below.kind == Node::Kind::kList && is_list_edit(own))
    return edited(std::move(below), std::move(own));
  if (are_united(below, own)) return united(std::move(below), std::move(own));
  const bool reaches_into_list = below.kind == Node::Kind::kList && is_mapping(own) && !own.whole &&
                                 own.place.layer == Layer::kCommandLine;
  if (reaches_into_list) return with_items_set(std::move(below), std::move(own));
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
  // A mapping of which the command line changes only inner values keeps its place in the file.
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

}  // namespace hal::files::config
