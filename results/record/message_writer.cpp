#include "results/record/message_writer.h"

#include "results/record/packet_name.h"

namespace results::record {

MessageWriter::MessageWriter(const Protocols& protocols)
    : protocols_(protocols),
      broadcasts_([this](auto... end) { on_message_end(hal::Time{}, hal::AgentId{}, end...); }) {}

void MessageWriter::on_relay_lost(hal::Time at, hal::AgentId source,
                                  const sim::radio::MacRequest& request, hal::Verdict verdict) {
  if (const auto message = packet_name(request, source, protocols_).message) {
    on_message_end(at, source, message->sender, message->id, verdict);
  }
}

std::vector<Table> MessageWriter::end_views() {
  return {
      {"message_ends",
       "outcome of messages, listed or counted; the counts add up to all messages sent",
       {{"sender", "INTEGER", "", "agent"},
        {"destination", "INTEGER", "", "agent, or everyone"},
        {"topic", "TEXT", "", "class of the message"},
        {"verdict", "TEXT", "", "as in messages; 'under way': on its way at the end of the run"},
        {"count", "INTEGER", "", "messages"},
        {"bytes", "INTEGER", "byte", "of their payloads"}},
       "sender, destination, topic, verdict",
       "SELECT sender, destination, topic, verdict, SUM(count) AS count, SUM(bytes) AS bytes FROM"
       " (SELECT sender, destination, topic, IFNULL(verdict, 'under way') AS verdict,"
       " COUNT(*) AS count, SUM(bytes) AS bytes FROM messages GROUP BY 1, 2, 3, 4"
       " UNION ALL SELECT sender, destination, topic, verdict, count, bytes FROM counted_ends"
       " WHERE count > 0) GROUP BY 1, 2, 3, 4"},
      {"message_fates",
       "fates reported to the senders of messages, listed or counted",
       {{"sender", "INTEGER", "", "agent"},
        {"destination", "INTEGER", "", "agent, or everyone"},
        {"topic", "TEXT", "", "class of the message"},
        {"fate", "TEXT", "", "reported to the sender"},
        {"count", "INTEGER", "", "messages"}},
       "sender, destination, topic, fate",
       "SELECT sender, destination, topic, fate, SUM(count) AS count FROM"
       " (SELECT sender, destination, topic, fate, COUNT(*) AS count FROM messages"
       " WHERE fate IS NOT NULL GROUP BY 1, 2, 3, 4"
       " UNION ALL SELECT sender, destination, topic, fate, count FROM counted_fates)"
       " GROUP BY 1, 2, 3, 4"},
  };
}

std::vector<Table> MessageWriter::delivery_views() {
  return {
      {"message_deliveries",
       "messages handed to controllers, listed or counted",
       {{"sender", "INTEGER", "", "agent that sent the messages"},
        {"destination", "INTEGER", "", "agent, or everyone"},
        {"topic", "TEXT", "", "class of the messages"},
        {"receiver", "INTEGER", "", "agent"},
        {"transmissions", "INTEGER", "", "on their way, the last hop included"},
        {"count", "INTEGER", "", "deliveries"},
        {"bytes", "INTEGER", "byte", "of their payloads"},
        {"late", "INTEGER", "",
         "so many of them came over 10 s after the message was sent, and after its sender was done "
         "with it, while messages were counted: the delays are of the others"},
        {"delay_sum_ns", "INTEGER", "ns", "of the times since they were sent"},
        {"delay_least_ns", "INTEGER", "ns", "the shortest"},
        {"delay_greatest_ns", "INTEGER", "ns", "the longest"}},
       "sender, destination, topic, receiver, transmissions",
       "SELECT sender, destination, topic, receiver, transmissions, SUM(count) AS count,"
       " SUM(bytes) AS bytes, SUM(late) AS late, SUM(delay_sum_ns) AS delay_sum_ns,"
       " MIN(delay_least_ns) AS delay_least_ns, MAX(delay_greatest_ns) AS delay_greatest_ns FROM"
       " (SELECT m.sender, m.destination, m.topic, d.receiver, d.transmissions, COUNT(*) AS count,"
       " SUM(m.bytes) AS bytes, 0 AS late, SUM(d.delay_ns) AS delay_sum_ns,"
       " MIN(d.delay_ns) AS delay_least_ns, MAX(d.delay_ns) AS delay_greatest_ns"
       " FROM deliveries d JOIN messages m USING (sender, id) GROUP BY 1, 2, 3, 4, 5"
       " UNION ALL SELECT * FROM counted_deliveries) GROUP BY 1, 2, 3, 4, 5"},
      {"broadcast_sums",
       "messages to everyone or to neighbours, listed or counted: how many were sent and received",
       {{"sender", "INTEGER", "", "agent"},
        {"topic", "TEXT", "", "class of the message"},
        {"messages", "INTEGER", "", "sent"},
        {"addressees", "INTEGER", "",
         "number of addressees of these messages in total: for each message all other agents"},
        {"reached", "INTEGER", "", "number of these addressees that received theirs"}},
       "sender, topic",
       "SELECT e.sender, e.topic, SUM(e.count) AS messages,"
       " SUM(e.count) * (SELECT COUNT(*) FROM agents WHERE agent <> e.sender) AS addressees,"
       " IFNULL(d.reached, 0) AS reached"
       " FROM message_ends e LEFT JOIN (SELECT sender, topic, SUM(count) AS reached"
       " FROM message_deliveries WHERE destination >= 65534 GROUP BY 1, 2) d"
       " ON d.sender = e.sender AND d.topic = e.topic WHERE e.destination >= 65534 GROUP BY 1, 2"},
  };
}

}  // namespace results::record
