#include "results/record/tallies.h"

#include <cmath>
#include <limits>

namespace results::record {
namespace {

/// No delay is reported for messages that take longer: their sending time is forgotten.
constexpr hal::Duration kLongestDelay = std::chrono::minutes{10};

bool is_to_one(const hal::Message& message) { return !hal::is_broadcast(message.destination); }

}  // namespace

Tallies::Tallies(hal::AgentId highest, OnEvent on_event) : on_event_(std::move(on_event)) {
  std::array<double, sim::scenario::kTallies> start{};
  for (const sim::scenario::TallyKind& kind : sim::scenario::tally_kinds()) {
    if (kind.is_of_events) {
      start[static_cast<std::size_t>(kind.tally)] = std::numeric_limits<double>::quiet_NaN();
    }
  }
  values_.assign(highest.value + std::size_t{1}, start);
}

std::optional<double> Tallies::value(hal::AgentId agent, sim::scenario::Tally tally) const {
  const double value = values_[agent.value][static_cast<std::size_t>(tally)];
  return std::isnan(value) ? std::nullopt : std::optional<double>{value};
}

void Tallies::on_message_sent(hal::Time at, const hal::Message& message) {
  while (!sent_order_.empty() && sent_order_.front().first + kLongestDelay < at) {
    sent_.erase(sent_order_.front().second);
    sent_order_.pop_front();
  }
  const MessageKey key{message.source, message.id};
  sent_[key] = at;
  sent_order_.emplace_back(at, key);
  if (is_to_one(message)) count(message.source, sim::scenario::Tally::kMessagesSent);
}

void Tallies::on_message_delivered(hal::Time at, hal::AgentId receiver,
                                   const hal::Message& message) {
  count(receiver, sim::scenario::Tally::kMessagesReceived);
  if (is_to_one(message)) count(message.source, sim::scenario::Tally::kMessagesArrived);
  const auto sent = sent_.find({message.source, message.id});
  if (sent == sent_.end()) return;
  using sim::scenario::Tally;
  const double delay = hal::to_seconds(at - sent->second);
  const std::size_t category = hal::access_category(message.priority);
  set(at, receiver, Tally::kDelay, delay);
  set(at, receiver, of_category(Tally::kDelayBackground, category), delay);
}

}  // namespace results::record
