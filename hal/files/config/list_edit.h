#pragma once

#include <string>

#include "hal/files/config/node.h"

namespace hal::files::config {

/// What changes a list instead of replacing it: `{add: [items …], remove: [names …]}`. `remove`
/// comes first, so that an item may be replaced by one of its name.

/// Whether a node is such a change: a mapping with `add` or `remove` and nothing else.
bool is_list_edit(const Node& node);

/// The list after the change. What cannot be done stays with it as entries "add", "remove" or, for
/// a name that is not there, "remove[]" with what is wrong as its text, for list_mistake() to say.
Node edited(Node list, Node edit);

/// Whether two such changes can become one: all that they say is lists.
bool are_united(const Node& below, const Node& own);

/// One change that does what both do, `below` first.
Node united(Node below, Node own);

/// Why an entry that stayed with a list is refused.
std::string list_mistake(const Node& list, const Entry& entry);

}  // namespace hal::files::config
