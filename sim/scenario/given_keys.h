#pragma once

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "sim/scenario/fields.h"

namespace sim::scenario {

/// Which of many kinds of thing a mapping says, by the key that is there. Of who surveys the keys
/// all are: then every kind is read, one after the other, so that each key is described once and
/// not on each way past the others.
class GivenKeys {
 public:
  explicit GivenKeys(const Mapping& in)
      : keys_(in.keys()), is_survey_(keys_ == std::vector<std::string>{"NAME"}) {}

  bool has(std::string_view key) const {
    return is_survey_ || std::ranges::find(keys_, key) != keys_.end();
  }
  /// Those that are not there count as known, so that one that is misspelt is told which it may be.
  void offer(Mapping& in, std::initializer_list<const char*> keys) const {
    for (const char* key : keys) {
      if (!has(key)) (void)in.has(key);
    }
  }
  /// Nobody asks what a file says, but what it may say.
  bool is_survey() const { return is_survey_; }

 private:
  std::vector<std::string> keys_;
  bool is_survey_;
};

}  // namespace sim::scenario
