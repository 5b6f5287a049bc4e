#include "results/record/message_sample.h"

#include <algorithm>
#include <utility>

namespace results::record {

MessageSample::MessageSample(Database& database, const Protocols& protocols, Commits& commits)
    : MessageWriter(protocols), log_(database, protocols, commits), counts_(database, protocols) {}

void MessageSample::on_message_sent(hal::Time at, const hal::Message& message) {
  Switches& switches = switches_of(message.source);
  const bool is_new = switches.empty() || message.id > switches.back();
  const bool is_listed = !hal::is_broadcast(message.destination) || has_room(at);
  if (is_new && is_listed == is_counted(switches, message.id)) switches.push_back(message.id);
  MessageWriter& writer = writer_of(message.source, message.id);
  note_row(at, message, writer);
  writer.on_message_sent(at, message);
}

void MessageSample::on_message_delivered(hal::Time at, hal::AgentId receiver,
                                         const hal::Message& message, int transmissions) {
  MessageWriter& writer = writer_of(message.source, message.id);
  note_row(at, message, writer);
  writer.on_message_delivered(at, receiver, message, transmissions);
}

void MessageSample::on_fate(hal::Time at, hal::AgentId sender, hal::MessageId id, hal::Fate fate) {
  writer_of(sender, id).on_fate(at, sender, id, fate);
}

void MessageSample::on_message_end(hal::Time at, hal::AgentId at_node, hal::AgentId sender,
                                   hal::MessageId id, hal::Verdict verdict) {
  writer_of(sender, id).on_message_end(at, at_node, sender, id, verdict);
}

bool MessageSample::is_counted(const Switches& switches, hal::MessageId id) {
  const auto after = std::ranges::upper_bound(switches, id);
  return (after - switches.begin()) % 2 == 1;
}

MessageSample::Switches& MessageSample::switches_of(hal::AgentId sender) {
  if (sender.value >= switches_.size()) switches_.resize(sender.value + 1u);
  return switches_[sender.value];
}

bool MessageSample::has_room(hal::Time at) {
  const std::int64_t second = hal::to_ns(at) / 1'000'000'000;
  if (std::exchange(second_, second) != second) rows_ = 0;
  return rows_ < kRowsOfSecond;
}

void MessageSample::note_row(hal::Time at, const hal::Message& message,
                             const MessageWriter& writer) {
  if (!hal::is_broadcast(message.destination) || &writer != &log_) return;
  (void)has_room(at);  // or begins a second
  ++rows_;
}

MessageWriter& MessageSample::writer_of(hal::AgentId sender, hal::MessageId id) {
  if (is_counted(switches_of(sender), id)) return counts_;
  return log_;
}

}  // namespace results::record
