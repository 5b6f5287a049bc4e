#include "gateway/server/inside_port.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace gateway::server {

using hal::node::exchange::Reply;

hal::Result<Reply> RecordedPort::finish() {
  hal::Result<Reply> reply = port_->finish();
  if (reply) record_(*reply);
  return reply;
}

hal::Result<std::optional<Reply>> RecordedPort::try_finish() {
  hal::Result<std::optional<Reply>> reply = port_->try_finish();
  if (reply && *reply) record_(**reply);
  return reply;
}

hal::Result<void> RepeatedPort::begin(const hal::node::exchange::Step& step) {
  run_ = step.run;
  sequence_ = step.sequence;
  asked_.clear();
  for (const auto& event : step.events) asked_.push_back(event.agent);
  if (time_ && !replies_.empty() && replies_.front().at > time_->now())
    time_->stop_at(replies_.front().at);
  return {};
}

hal::Result<std::optional<Reply>> RepeatedPort::try_finish() {
  const bool is_early = time_ && (replies_.empty() || replies_.front().at > time_->now());
  if (is_early) return std::nullopt;
  auto reply = finish();
  if (!reply) return tl::unexpected(reply.error());
  return std::move(*reply);
}

hal::Result<Reply> RepeatedPort::finish() {
  if (replies_.empty()) {
    return hal::fail(hal::Errc::kProtocol,
                     fmt::format("the record has no further answer of '{}'", name_));
  }
  Reply reply = std::move(replies_.front().reply);
  replies_.pop_front();
  const bool is_its = std::ranges::all_of(reply.actions, [this](const auto& action) {
    return action.event < asked_.size() && asked_[action.event] == action.agent;
  });
  if (!is_its) {
    return hal::fail(hal::Errc::kProtocol,
                     fmt::format("an answer of '{}' in the record is to another Step", name_));
  }
  record_(reply);
  reply.run = run_;
  reply.sequence = sequence_;
  return reply;
}

}  // namespace gateway::server
