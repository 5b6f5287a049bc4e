#pragma once

#include <functional>
#include <map>
#include <string>

#include "hal/files/description/fields.h"
#include "hal/types/priority.h"

namespace hal::files::description {

/// The key `priorities`: priorities of messages by their topic, which replace those of the
/// controllers.
void priorities_key(Fields& io, std::map<std::string, Priority, std::less<>>& priorities);

/// A key for one priority, by its number or by the name of an access category.
void priority_key(Fields& io, const Key& key, Priority& priority);

}  // namespace hal::files::description
