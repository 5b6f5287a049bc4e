#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/radio/radio_rules.h"

namespace sim::radio {

/// Collects the rules that are broken.
class Rules {
 public:
  void ask(bool holds, std::string_view key, std::string what) {
    if (!holds) broken_.push_back({std::string(key), std::move(what)});
  }
  bool is_empty() const { return broken_.empty(); }
  std::vector<BrokenRule> take() { return std::move(broken_); }

 private:
  std::vector<BrokenRule> broken_;
};

}  // namespace sim::radio
