#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "hal/types/priority.h"
#include "sim/agents/observer.h"

namespace baraka::run {

/// Finds the entries of `priorities` that no message of a run used.
class UnusedPriorities final : public sim::agents::Observer {
 public:
  using Priorities = std::map<std::string, hal::Priority, std::less<>>;

  /// @param priorities  by topic; outlive this object.
  explicit UnusedPriorities(const Priorities& priorities) : priorities_(priorities) {}

  void on_message_sent(hal::Time at, const hal::Message& message) override;

  /// One line for display for each entry, by topic.
  std::vector<std::string> lines() const;

 private:
  const Priorities& priorities_;
  std::set<std::string, std::less<>> sent_;  ///< Topics.
};

}  // namespace baraka::run
