#pragma once

#include <string_view>

namespace hal::node::devices {

/// One of the values of a reading, as `record: observables` names it.
struct ValueName {
  std::string_view name;
  std::string_view unit;
};

}  // namespace hal::node::devices
