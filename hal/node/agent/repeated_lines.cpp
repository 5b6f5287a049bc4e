#include "hal/node/agent/repeated_lines.h"

#include <fmt/format.h>

#include <utility>

namespace hal::node::agent {

std::optional<std::string> RepeatedLines::take(Time now, const std::string& text) {
  const auto known = said_.find(text);
  if (known == said_.end()) {
    if (said_.size() >= kMostTexts) said_.clear();
    said_[text].at = now;
    return text;
  }
  Said& said = known->second;
  if (now - said.at < kPeriod) {
    ++said.since;
    return std::nullopt;
  }
  said.at = now;
  const std::uint64_t since = std::exchange(said.since, 0);
  return since == 0 ? text : fmt::format("{} ({} times more meanwhile)", text, since);
}

}  // namespace hal::node::agent
