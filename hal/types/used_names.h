#pragma once

#include <fmt/core.h>

#include <set>
#include <string>
#include <string_view>

#include "hal/types/message.h"
#include "hal/types/record.h"
#include "hal/types/result.h"

namespace hal {

/// The names of one kind that an agent has used so far, of which it may use so many.
class UsedNames {
 public:
  /// @param kind  for messages: "topic".
  UsedNames(std::string_view kind, std::size_t most) : kind_(kind), most_(most) {}

  /// Notes a name. Errors: kInvalidArgument (it is one too many); then it is not noted.
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

/// The topics that an agent has given its messages.
struct Topics : UsedNames {
  Topics() : UsedNames("topic", kMaxTopics) {}
};

/// The names under which an agent has recorded values.
struct RecordedNames : UsedNames {
  RecordedNames() : UsedNames("value", kMaxRecordedNames) {}
};

}  // namespace hal
