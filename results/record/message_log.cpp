#include "results/record/message_log.h"

#include <utility>

namespace results::record {

MessageLog::MessageLog(Database& database, const Protocols& protocols, Commits& commits)
    : MessageWriter(protocols),
      insert_(database,
              "REPLACE INTO messages (sender, id, destination, topic, bytes, sent_ns, priority)"
              " VALUES (?, ?, ?, ?, ?, ?, ?)"),
      insert_delivery_(database, "REPLACE INTO deliveries VALUES (?, ?, ?, ?, ?, ?)"),
      find_delivery_(database,
                     "REPLACE INTO deliveries SELECT sender, id, ?3, ?4, ?4 - sent_ns, ?5"
                     " FROM messages WHERE sender = ?1 AND id = ?2"),
      set_fate_(database, "UPDATE messages SET fate = ?, fate_ns = ? WHERE sender = ? AND id = ?"),
      set_delivered_(database,
                     "UPDATE messages SET verdict = 'delivered' WHERE sender = ? AND id = ?"),
      set_verdict_(database,
                   "UPDATE messages SET verdict = ? WHERE sender = ? AND id = ?"
                   " AND verdict IS NOT 'delivered'"),
      commits_(commits) {}

void MessageLog::on_message_sent(hal::Time at, const hal::Message& message) {
  insert_.run(message.source.value, std::int64_t{message.id}, message.destination.value,
              message.topic, std::uint64_t{message.payload.size()}, hal::to_ns(at),
              hal::to_number(message.priority));
  const std::size_t sender = message.source.value;
  if (sender >= latest_.size()) latest_.resize(sender + 1);
  latest_[sender].resize(kLatest);
  latest_[sender][message.id % kLatest] = {.id = message.id, .sent = at};
  commits_.on_rows(at, 1);
}

MessageLog::Sent* MessageLog::find(hal::AgentId sender, hal::MessageId id) {
  if (sender.value >= latest_.size() || latest_[sender.value].empty()) return nullptr;
  Sent& sent = latest_[sender.value][id % kLatest];
  return sent.id == id ? &sent : nullptr;
}

void MessageLog::on_message_delivered(hal::Time at, hal::AgentId receiver,
                                      const hal::Message& message, int transmissions) {
  const auto sender = message.source.value;
  const std::int64_t id = message.id;
  Sent* const sent = find(message.source, message.id);
  if (sent != nullptr) {
    insert_delivery_.run(sender, id, receiver.value, hal::to_ns(at), (at - sent->sent).count(),
                         transmissions);
  } else {
    find_delivery_.run(sender, id, receiver.value, hal::to_ns(at), transmissions);
  }
  if (sent == nullptr || !std::exchange(sent->is_delivered, true)) set_delivered_.run(sender, id);
  commits_.on_rows(at, 1);
}

void MessageLog::on_fate(hal::Time at, hal::AgentId sender, hal::MessageId id, hal::Fate fate) {
  set_fate_.run(hal::to_string(fate), hal::to_ns(at), sender.value, std::int64_t{id});
}

void MessageLog::on_message_end(hal::Time, hal::AgentId, hal::AgentId sender, hal::MessageId id,
                                hal::Verdict verdict) {
  const Sent* const sent = find(sender, id);
  if (sent != nullptr && sent->is_delivered) return;
  set_verdict_.run(hal::name(verdict), sender.value, std::int64_t{id});
}

std::vector<Table> MessageLog::tables() {
  return {
      {"messages",
       "messages that controllers sent, one by one: each with record: {messages: all}; with "
       "`sample`, the default up to 100 agents, those to one agent, and of those to everyone and "
       "to neighbours the first of each simulated second, until they and their deliveries are 1000 "
       "rows",
       {{"sender", "INTEGER NOT NULL", "", "agent"},
        {"id", "INTEGER NOT NULL", "", "number of the message, counted by its sender"},
        {"destination", "INTEGER NOT NULL", "", "agent; 65535: everyone, 65534: neighbours"},
        {"topic", "TEXT NOT NULL", "", "class of the message"},
        {"bytes", "INTEGER NOT NULL", "byte", "payload"},
        {"sent_ns", "INTEGER NOT NULL", "ns", "when the controller sent it"},
        {"fate", "TEXT", "", "fate reported to the sender; null: none yet"},
        {"fate_ns", "INTEGER", "ns", "when the fate was reported"},
        {"verdict", "TEXT", "",
         "outcome; 'delivered' if any copy arrived; null: still on its way at the end of the run; "
         "for a broadcast that nobody received, the most frequent reason, 'below sensitivity' if "
         "no radio was in range"},
        {"priority", "INTEGER NOT NULL", "",
         "user priority, 0 to 7: 1 and 2 background, 0 and 3 best effort, 4 and 5 video, 6 and 7 "
         "voice"}},
       "sender, id"},
      {"broadcasts",
       "listed messages to everyone or to neighbours, with the number of agents that received them",
       {{"sender", "INTEGER", "", "agent"},
        {"id", "INTEGER", "", "number of the message, counted by its sender"},
        {"topic", "TEXT", "", "class of the message"},
        {"sent_ns", "INTEGER", "ns", "when the controller sent it"},
        {"addressees", "INTEGER", "", "all other agents"},
        {"reached", "INTEGER", "", "number of agents that received it"},
        {"verdict", "TEXT", "", "as in messages"}},
       "sender, id",
       "SELECT sender, id, topic, sent_ns,"
       " (SELECT COUNT(*) FROM agents WHERE agent <> m.sender) AS addressees,"
       " (SELECT COUNT(*) FROM deliveries d WHERE d.sender = m.sender AND d.id = m.id) AS reached,"
       " verdict FROM messages m WHERE destination >= 65534"},
      {"deliveries",
       "listed messages handed to a controller; one to everyone or to neighbours once per agent",
       {{"sender", "INTEGER NOT NULL", "", "agent that sent the message"},
        {"id", "INTEGER NOT NULL", "", "number of the message, counted by its sender"},
        {"receiver", "INTEGER NOT NULL", "", "agent"},
        {"at_ns", "INTEGER NOT NULL", "ns", "when"},
        {"delay_ns", "INTEGER NOT NULL", "ns", "since it was sent, waiting for a route included"},
        {"transmissions", "INTEGER", "", "on its way, the last hop included"}},
       "sender, id, receiver"},
  };
}

}  // namespace results::record
