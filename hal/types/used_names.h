#pragma once

#include <fmt/core.h>

#include <set>
#include <string>
#include <string_view>

#include "hal/types/message.h"
#include "hal/types/record.h"
#include "hal/types/result.h"

namespace hal {

/// The names of one kind that an agent has used so far; their number is limited.
class UsedNames {
 public:
  /// @param kind  what the names are, for error messages: "topic".
  /// @param most  number of different names that are allowed.
  UsedNames(std::string_view kind, std::size_t most) : kind_(kind), most_(most) {}

  /// Notes a name. Errors: kInvalidArgument if `most` other names are known; the name is then not
  /// noted.
  Result<void> admit(std::string_view name) {
    if (known_.contains(name)) return {};
    if (known_.size() >= most_) {
      return fail(Errc::kInvalidArgument,
                  fmt::format("'{}' would be {} {} of this agent, at most {} are allowed", name,
                              kind_, known_.size() + 1, most_));
    }
    known_.emplace(name);
    return {};
  }

 private:
  std::string_view kind_;
  std::size_t most_;
  std::set<std::string, std::less<>> known_;
};

/// The topics of an agent's messages so far.
struct Topics : UsedNames {
  /// None so far, at most kMaxTopics.
  Topics() : UsedNames("topic", kMaxTopics) {}
};

/// The names of an agent's recorded values so far.
struct RecordedNames : UsedNames {
  /// None so far, at most kMaxRecordedNames.
  RecordedNames() : UsedNames("value", kMaxRecordedNames) {}
};

}  // namespace hal
