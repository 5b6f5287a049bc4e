#pragma once

#include <fmt/core.h>

#include <set>
#include <string>
#include <string_view>

#include "hal/types/message.h"
#include "hal/types/result.h"

namespace hal {

/// The topics that one agent has given its messages so far; at most kMaxTopics.
class Topics {
 public:
  /// Notes a topic. Errors: kInvalidArgument (it is one too many); then it is not noted.
  Result<void> admit(std::string_view topic) {
    if (known_.contains(topic)) return {};
    if (known_.size() >= kMaxTopics) {
      return fail(Errc::kInvalidArgument,
                  fmt::format("'{}' would be topic {} of this agent, at most {} are allowed", topic,
                              known_.size() + 1, kMaxTopics));
    }
    known_.emplace(topic);
    return {};
  }

 private:
  std::set<std::string, std::less<>> known_;
};

}  // namespace hal
