#pragma once

#include <string>

#include "hal/files/config/node.h"

namespace hal::files::config {

/// A change of a list instead of its replacement: `{add: [items …], remove: [names …]}`. `remove`
/// is applied first, so that an item may be replaced by one with the same name.

/// Whether a node is such a change: a mapping with only `add` or `remove` as keys.
bool is_list_edit(const Node& node);

/// The list after the change. Parts that cannot be applied are kept in the list as entries "add",
/// "remove" or, for a name that is not in the list, "remove[]" with the problem as text;
/// list_mistake() describes them.
Node edited(Node list, Node edit);

/// Whether two such changes can be combined: all their values are lists.
bool are_united(const Node& below, const Node& own);

/// One change with the effect of both, `below` first.
Node united(Node below, Node own);

/// Why an entry that was kept in a list is refused.
std::string list_mistake(const Node& list, const Entry& entry);

}  // namespace hal::files::config
