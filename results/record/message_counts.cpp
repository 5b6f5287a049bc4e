#include "results/record/message_counts.h"

#include <algorithm>
#include <utility>

namespace results::record {
namespace {

constexpr hal::MessageId kForgetEvery = 32;
/// Verdict and fate of a number without a message, which is so never waited for.
constexpr auto kNoMessage = static_cast<std::uint8_t>(hal::Verdict::kDelivered);

}  // namespace

MessageCounts::MessageCounts(Database& database, const Protocols& protocols)
    : MessageWriter(protocols),
      put_end_(database, "REPLACE INTO counted_ends VALUES (?, ?, ?, ?, ?, ?)"),
      put_fate_(database, "REPLACE INTO counted_fates VALUES (?, ?, ?, ?, ?)"),
      put_delivery_(database,
                    "REPLACE INTO counted_deliveries VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)") {}

void MessageCounts::on_message_sent(hal::Time at, const hal::Message& message) {
  Sender& from = sender(message.source);
  // Old messages are removed only from time to time: they are no longer in the cache.
  if (message.id % kForgetEvery == 0) forget(from, at);
  if (from.sent.empty()) from.first = message.id;
  // Numbers in between belong to no message of these: nothing more will be known of them.
  while (from.first + from.sent.size() < message.id) {
    from.sent.push_back({.at = at, .verdict = kNoMessage, .fate = kNoMessage});
  }
  const Sent sent{.at = at,
                  .kind = kind_of(from, message),
                  .bytes = static_cast<std::uint16_t>(message.payload.size())};
  from.sent.push_back(sent);
  Kind& kind = from.kinds[sent.kind];
  count(kind, kind.ends, kNothingYet, sent);
}

void MessageCounts::on_message_delivered(hal::Time at, hal::AgentId receiver,
                                         const hal::Message& message, int transmissions) {
  Sender& from = sender(message.source);
  const Sent* const sent = find(from, message.id);
  std::optional<hal::Duration> delay;
  if (sent != nullptr) delay = at - sent->at;
  const std::uint32_t kind = sent != nullptr ? sent->kind : kind_of(from, message);
  changed_ += from.deliveries.add({.receiver = receiver,
                                   .transmissions = static_cast<std::uint16_t>(transmissions),
                                   .kind = kind},
                                  message.payload.size(), delay)
                  ? 1
                  : 0;
  from.kinds[kind].changed = true;
  ++counted_;
  on_message_end(at, receiver, message.source, message.id, hal::Verdict::kDelivered);
}

void MessageCounts::on_fate(hal::Time, hal::AgentId agent, hal::MessageId id, hal::Fate fate) {
  Sender& from = sender(agent);
  Sent* const sent = find(from, id);
  if (sent == nullptr || sent->fate != kNothingYet) return;
  sent->fate = static_cast<std::uint8_t>(fate);
  Kind& kind = from.kinds[sent->kind];
  count(kind, kind.fates, sent->fate, *sent);
  if (id < from.first && sent->is_settled()) from.unsettled.erase(id);
}

void MessageCounts::on_message_end(hal::Time, hal::AgentId, hal::AgentId agent, hal::MessageId id,
                                   hal::Verdict verdict) {
  constexpr auto kDelivered = static_cast<std::uint8_t>(hal::Verdict::kDelivered);
  Sender& from = sender(agent);
  Sent* const sent = find(from, id);
  if (sent == nullptr || sent->verdict == kDelivered) return;
  Kind& kind = from.kinds[sent->kind];
  Count& before = count_of(kind.ends, sent->verdict);
  --before.messages;
  before.bytes -= sent->bytes;
  before.changed = true;
  sent->verdict = static_cast<std::uint8_t>(verdict);
  count(kind, kind.ends, sent->verdict, *sent);
  if (id < from.first && sent->is_settled()) from.unsettled.erase(id);
}

MessageCounts::Sender& MessageCounts::sender(hal::AgentId agent) {
  if (agent.value >= senders_.size()) senders_.resize(agent.value + 1u);
  return senders_[agent.value];
}

/// Null: it was settled and removed.
MessageCounts::Sent* MessageCounts::find(Sender& sender, hal::MessageId id) {
  if (id >= sender.first) {
    const std::size_t place = id - sender.first;
    return place < sender.sent.size() ? &sender.sent[place] : nullptr;
  }
  const auto found = sender.unsettled.find(id);
  return found == sender.unsettled.end() ? nullptr : &found->second;
}

std::uint32_t MessageCounts::kind_of(Sender& sender, const hal::Message& message) {
  if (!sender.kinds.empty()) {
    const Kind& last = sender.kinds[sender.last_kind];
    const bool is_it =
        last.destination == message.destination && topics_[last.topic] == message.topic;
    if (is_it) return sender.last_kind;
  }
  auto topic = topic_numbers_.find(message.topic);
  if (topic == topic_numbers_.end()) {
    topic = topic_numbers_.emplace(message.topic, static_cast<std::uint32_t>(topics_.size())).first;
    topics_.push_back(message.topic);
  }
  const auto next = static_cast<std::uint32_t>(sender.kinds.size());
  const auto [place, is_new] =
      sender.places.try_emplace({topic->second, message.destination.value}, next);
  if (is_new) sender.kinds.push_back({.topic = topic->second, .destination = message.destination});
  return sender.last_kind = place->second;
}

MessageCounts::Count& MessageCounts::count_of(Counts& counts, std::uint8_t key) {
  const auto found = std::ranges::find(counts, key, &Count::key);
  return found != counts.end() ? *found : counts.emplace_back(Count{.key = key});
}

void MessageCounts::count(Kind& kind, Counts& counts, std::uint8_t key, const Sent& sent) {
  Count& count = count_of(counts, key);
  ++count.messages;
  count.bytes += sent.bytes;
  count.changed = true;
  ++counted_;
  // An estimate of the rows of a changed kind: its old verdict, its new one, and a fate.
  if (!std::exchange(kind.changed, true)) changed_ += 3;
}

void MessageCounts::forget(Sender& sender, hal::Time now) {
  while (!sender.sent.empty() && sender.sent.front().at + kKept < now) {
    const Sent& oldest = sender.sent.front();
    if (!oldest.is_settled()) sender.unsettled.emplace(sender.first, oldest);
    sender.sent.pop_front();
    ++sender.first;
  }
}

void MessageCounts::write(hal::Time) {
  for (std::size_t address = 0; address < senders_.size(); ++address) {
    write(static_cast<std::uint16_t>(address), senders_[address]);
  }
  counted_ = changed_ = 0;
}

void MessageCounts::write(std::uint16_t address, Sender& sender) {
  for (Kind& kind : sender.kinds) {
    if (std::exchange(kind.changed, false)) write_kind(address, kind);
  }
  sender.deliveries.write_changes([&](const DeliveryTotals::Total& total) {
    const Kind& kind = sender.kinds[total.key.kind];
    std::optional<std::int64_t> least;
    std::optional<std::int64_t> greatest;
    if (total.late < total.count) {
      least = total.least.count();
      greatest = total.greatest.count();
    }
    put_delivery_.run(address, kind.destination.value, topics_[kind.topic],
                      total.key.receiver.value, total.key.transmissions, total.count, total.bytes,
                      total.late, total.sum.count(), least, greatest);
  });
}

void MessageCounts::write_kind(std::uint16_t address, Kind& kind) {
  for (Count& count : kind.ends) {
    if (!std::exchange(count.changed, false)) continue;
    put_end_.run(address, kind.destination.value, topics_[kind.topic],
                 count.key == kNothingYet ? std::string_view("under way")
                                          : hal::name(static_cast<hal::Verdict>(count.key)),
                 count.messages, count.bytes);
  }
  for (Count& count : kind.fates) {
    if (!std::exchange(count.changed, false)) continue;
    put_fate_.run(address, kind.destination.value, topics_[kind.topic],
                  hal::to_string(static_cast<hal::Fate>(count.key)), count.messages);
  }
}

std::vector<Table> MessageCounts::tables() {
  return {
      {"counted_ends",
       "outcome of the messages that have no row of their own (record: {messages: counts} or "
       "sample); use message_ends",
       {{"sender", "INTEGER NOT NULL", "", "agent"},
        {"destination", "INTEGER NOT NULL", "", "agent; 65535: everyone, 65534: neighbours"},
        {"topic", "TEXT NOT NULL", "", "class of the message"},
        {"verdict", "TEXT NOT NULL", "", "as in message_ends"},
        {"count", "INTEGER NOT NULL", "", "messages"},
        {"bytes", "INTEGER NOT NULL", "byte", "total size of their payloads"}},
       "sender, destination, topic, verdict"},
      {"counted_fates",
       "the same messages by the fate reported to their senders; use message_fates",
       {{"sender", "INTEGER NOT NULL", "", "agent"},
        {"destination", "INTEGER NOT NULL", "", "agent; 65535: everyone, 65534: neighbours"},
        {"topic", "TEXT NOT NULL", "", "class of the message"},
        {"fate", "TEXT NOT NULL", "", "reported to the sender"},
        {"count", "INTEGER NOT NULL", "", "messages"}},
       "sender, destination, topic, fate"},
      {"counted_deliveries",
       "deliveries that have no row of their own; use message_deliveries",
       {{"sender", "INTEGER NOT NULL", "", "agent that sent the messages"},
        {"destination", "INTEGER NOT NULL", "", "agent; 65535: everyone, 65534: neighbours"},
        {"topic", "TEXT NOT NULL", "", "class of the messages"},
        {"receiver", "INTEGER NOT NULL", "", "agent"},
        {"transmissions", "INTEGER NOT NULL", "", "hops on their way, including the last"},
        {"count", "INTEGER NOT NULL", "", "deliveries"},
        {"bytes", "INTEGER NOT NULL", "byte", "total size of their payloads"},
        {"late", "INTEGER NOT NULL", "", "as in message_deliveries"},
        {"delay_sum_ns", "INTEGER NOT NULL", "ns", "as in message_deliveries"},
        {"delay_least_ns", "INTEGER", "ns", "shortest delay; null: all were late"},
        {"delay_greatest_ns", "INTEGER", "ns", "longest delay; null: all were late"}},
       "sender, destination, topic, receiver, transmissions"},
  };
}

}  // namespace results::record
