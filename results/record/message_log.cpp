#include "results/record/message_log.h"

namespace results::record {

MessageLog::MessageLog(Database& database)
    : insert_(database,
              "REPLACE INTO messages (sender, id, destination, topic, bytes, sent_ns)"
              " VALUES (?, ?, ?, ?, ?, ?)"),
      insert_delivery_(database,
                       "REPLACE INTO deliveries SELECT sender, id, ?3, ?4, ?4 - sent_ns, ?5"
                       " FROM messages WHERE sender = ?1 AND id = ?2"),
      set_fate_(database, "UPDATE messages SET fate = ?, fate_ns = ? WHERE sender = ? AND id = ?"),
      set_delivered_(database,
                     "UPDATE messages SET verdict = 'delivered' WHERE sender = ? AND id = ?"),
      set_verdict_(database,
                   "UPDATE messages SET verdict = ? WHERE sender = ? AND id = ?"
                   " AND verdict IS NOT 'delivered'") {}

void MessageLog::on_sent(hal::Time at, const hal::Message& message) {
  insert_.run(message.source.value, std::int64_t{message.id}, message.destination.value,
              message.topic, std::uint64_t{message.payload.size()}, hal::to_ns(at));
}

void MessageLog::on_message_delivered(hal::Time at, hal::AgentId receiver,
                                      const hal::Message& message, int transmissions) {
  insert_delivery_.run(message.source.value, std::int64_t{message.id}, receiver.value,
                       hal::to_ns(at), transmissions);
  set_delivered_.run(message.source.value, std::int64_t{message.id});
}

void MessageLog::on_fate(hal::Time at, hal::AgentId sender, hal::MessageId id, hal::Fate fate) {
  set_fate_.run(hal::to_string(fate), hal::to_ns(at), sender.value, std::int64_t{id});
}

void MessageLog::on_end(hal::AgentId sender, hal::MessageId id, hal::Verdict verdict) {
  set_verdict_.run(hal::name(verdict), sender.value, std::int64_t{id});
}

}  // namespace results::record
