#include "baraka/run/unused_priorities.h"

#include <fmt/format.h>

#include "hal/files/config/suggest.h"

namespace baraka::run {

void UnusedPriorities::on_message_sent(hal::Time /*at*/, const hal::Message& message) {
  if (!sent_.contains(message.topic)) sent_.insert(message.topic);
}

std::vector<std::string> UnusedPriorities::lines() const {
  const std::vector<std::string> topics(sent_.begin(), sent_.end());
  std::vector<std::string> lines;
  for (const auto& [topic, priority] : priorities_) {
    if (sent_.contains(topic)) continue;
    lines.push_back(fmt::format("priorities.{}: no message had this topic{}", topic,
                                hal::files::config::suggestion(topic, topics)));
  }
  return lines;
}

}  // namespace baraka::run
