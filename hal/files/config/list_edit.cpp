#include "hal/files/config/list_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

namespace hal::files::config {
namespace {

using Kind = Node::Kind;

constexpr const char* kNotThere = "remove[]";

/// The name of an item: its `name`, otherwise its `kind`; for a scalar its text.
std::string name_of(const Node& item) {
  if (item.kind == Kind::kScalar) return item.text;
  for (const char* const key : {"name", "kind"}) {
    const Entry* const entry = item.find(key);
    if (entry != nullptr && entry->value.kind == Kind::kScalar) return entry->value.text;
  }
  return {};
}

bool remove_named(std::vector<Node>& items, const Node& name) {
  return name.kind == Kind::kScalar &&
         std::erase_if(items, [&](const Node& item) { return name_of(item) == name.text; }) > 0;
}

void append(std::vector<Node>& items, std::vector<Node> more) {
  std::ranges::move(more, std::back_inserter(items));
}

bool is_of_lists(const Node& edit) {
  return std::ranges::all_of(edit.entries,
                             [](const Entry& entry) { return entry.value.kind == Kind::kList; });
}

/// "a, b", or "none".
std::string listed(const std::vector<Node>& items) {
  std::vector<std::string> names;
  for (const Node& item : items) {
    if (std::string name = name_of(item); !name.empty()) names.push_back(std::move(name));
  }
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

void remove_all(Node& list, Entry& names) {
  for (const Node& name : names.value.items) {
    if (remove_named(list.items, name)) continue;
    Node mistake;
    mistake.kind = Kind::kScalar;
    mistake.place = name.place;
    mistake.text = fmt::format("there is no {} to remove; the list has {}", kind_name(name),
                               listed(list.items));
    list.entries.push_back({kNotThere, name.place, std::move(mistake)});
  }
}

}  // namespace

bool is_list_edit(const Node& node) {
  return node.kind == Kind::kMapping && !node.entries.empty() &&
         std::ranges::all_of(node.entries, [](const Entry& entry) {
           return entry.key == "add" || entry.key == "remove";
         });
}

bool are_united(const Node& below, const Node& own) {
  return is_list_edit(below) && is_list_edit(own) && is_of_lists(below) && is_of_lists(own);
}

Node edited(Node list, Node edit) {
  Entry* const removed = edit.find("remove");
  if (removed != nullptr && removed->value.kind == Kind::kList) remove_all(list, *removed);
  Entry* const added = edit.find("add");
  if (added != nullptr && added->value.kind == Kind::kList)
    append(list.items, std::move(added->value.items));
  for (Entry& entry : edit.entries) {
    if (entry.value.kind != Kind::kList) list.entries.push_back(std::move(entry));
  }
  return list;
}

Node united(Node below, Node own) {
  Entry* const below_added = below.find("add");
  Entry* const removed = own.find("remove");
  if (below_added != nullptr && removed != nullptr) {
    std::erase_if(removed->value.items,
                  [&](const Node& name) { return remove_named(below_added->value.items, name); });
  }
  for (Entry& entry : own.entries) {
    if (Entry* const lower = below.find(entry.key)) {
      append(lower->value.items, std::move(entry.value.items));
    } else {
      below.entries.push_back(std::move(entry));
    }
  }
  return below;
}

std::string list_mistake(const Node& list, const Entry& entry) {
  if (entry.key == kNotThere) return entry.value.text;
  if (entry.key == "add") return "add must be a list of items, not " + kind_name(entry.value);
  if (entry.key == "remove") return "remove must be a list of names, not " + kind_name(entry.value);
  const std::size_t size = list.items.size();
  return fmt::format("'{}' is not an item: the list has {}{}", entry.key, size,
                     size > 0 ? fmt::format(", 0 to {}", size - 1) : "");
}

}  // namespace hal::files::config
