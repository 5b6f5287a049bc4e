// The tables of run.sqlite that hold the ledger of the air.
#include "results/record/ledger_tables.h"

namespace results::record {
namespace {

std::vector<Table> air_account_tables() {
  return {
      {"air_accounts",
       "if an agent has a network: the use of the air. A frame's bits and air time are "
       "shared "
       "out over what it carries in proportion to the bytes of that, headers and preamble with it, "
       "what is left over to the largest remainders; the frame counts once, as its largest part "
       "(of equals the first): the sums over all accounts of an agent are those of its radio",
       {{"account", "INTEGER PRIMARY KEY", "", "number"},
        {"agent", "INTEGER NOT NULL", "", "transmitter"},
        {"purpose", "TEXT NOT NULL", "",
         "of RTPS: 'user' (topics of programs), 'SPDP', 'SEDP', 'liveliness', 'builtin' (other "
         "endpoints of the middleware), 'RTPS' (none); 'network' (what else programs send), "
         "'routing', '802.11' (control and management), 'other'"},
        {"kind", "TEXT NOT NULL", "",
         "of RTPS the submessage, of a vendor 'vendor 0x80'; 'ARP', 'ICMP', 'IGMP', 'ICMPv6', "
         "'TCP', 'UDP', 'IP 132', 'fragments' (of which the first was not seen), 'malformed'; "
         "'ack', 'rts', 'beacon', ...; else the Ethertype"},
        {"port", "INTEGER", "",
         "of TCP and UDP that is no RTPS: the lower one of the two; null: both from 32768 on"},
        {"topic", "TEXT", "", "of 'user', as SEDP on the air had told; null: it had not"},
        {"frames", "INTEGER NOT NULL", "", "whose largest part is of this kind"},
        {"retries", "INTEGER NOT NULL", "", "so many of these were sent before"},
        {"submessages", "INTEGER NOT NULL", "",
         "that begin in frames sent for the first time; of what has no submessages: frames"},
        {"repeated", "INTEGER NOT NULL", "", "that begin in retries"},
        {"bits", "INTEGER NOT NULL", "bit", "share of the frames' lengths on the air"},
        {"airtime_ns", "INTEGER NOT NULL", "ns", "share of the time on the air"}}},
      {"air_ends",
       "how the frames of air_accounts ended at the radios that could receive or sense them",
       {{"account", "INTEGER NOT NULL", "", "as in air_accounts"},
        {"agent", "INTEGER NOT NULL", "", "receiver"},
        {"addressed", "INTEGER NOT NULL", "", "1: to this agent or to everyone"},
        {"verdict", "TEXT NOT NULL", "", "outcome"},
        {"frames", "INTEGER NOT NULL", "", "counted as in air_accounts: in sum the receptions"},
        {"parts", "INTEGER NOT NULL", "",
         "of the kind that such frames carried, whole or in part"}},
       "account, agent, addressed, verdict"},
  };
}

std::vector<Table> writer_tables() {
  return {
      {"air_writers",
       "the same by writer: submessages from it or, ACKNACK and NACK_FRAG, about it",
       {{"agent", "INTEGER NOT NULL", "", "transmitter"},
        {"writer", "TEXT NOT NULL", "", "GUID"},
        {"purpose", "TEXT NOT NULL", "", "as in air_accounts"},
        {"kind", "TEXT NOT NULL", "", "as in air_accounts"},
        {"topic", "TEXT NOT NULL", "", "as in air_accounts; '' for null"},
        {"submessages", "INTEGER NOT NULL", "", "as in air_accounts"},
        {"repeated", "INTEGER NOT NULL", "", "as in air_accounts"},
        {"bits", "INTEGER NOT NULL", "bit", "as in air_accounts"},
        {"airtime_ns", "INTEGER NOT NULL", "ns", "as in air_accounts"}},
       "agent, writer, purpose, kind, topic"},
      {"air_seconds",
       "air time of all agents by kind and second",
       {{"second", "INTEGER NOT NULL", "", "number of the simulated second, from 0"},
        {"purpose", "TEXT NOT NULL", "", "as in air_accounts"},
        {"kind", "TEXT NOT NULL", "", "as in air_accounts"},
        {"airtime_ns", "INTEGER NOT NULL", "ns", "of the frames that began in it"}},
       "second, purpose, kind"},
  };
}

std::vector<Table> sample_tables() {
  return {
      {"dds_endpoints",
       "writers and readers announced by SEDP on the air",
       {{"guid", "TEXT PRIMARY KEY", "", "hexadecimal"},
        {"agent", "INTEGER", "", "agent whose programs have it; null: they sent nothing"},
        {"kind", "TEXT NOT NULL", "", "'writer' or 'reader'"},
        {"topic", "TEXT NOT NULL", "", "name"},
        {"type", "TEXT NOT NULL", "", "name"},
        {"reliability", "TEXT NOT NULL", "", "'reliable' or 'best effort'"},
        {"durability", "TEXT NOT NULL", "", "'volatile', 'transient local', ..."},
        {"told_ns", "INTEGER", "ns", "when it was first announced"}}},
      {"sample_sums",
       "samples of the writers of programs at other agents with a reader that was matched when "
       "they were "
       "first sent: topic, type, reliability, durability and partition fit, and SEDP's word of "
       "each "
       "had come to the other. Not with record: {samples: none}",
       {{"writer", "TEXT NOT NULL", "", "GUID, as in dds_endpoints"},
        {"receiver", "INTEGER NOT NULL", "", "agent"},
        {"samples", "INTEGER NOT NULL", "", "sent, and settled 10 s after they were last sent"},
        {"delivered", "INTEGER NOT NULL", "", "whole into the receiver's interface"},
        {"first_try", "INTEGER NOT NULL", "",
         "of these, by what DDS sent first; retries of 802.11 do not count"},
        {"under_way", "INTEGER NOT NULL", "", "neither delivered nor lost when the run ended"},
        {"repairs", "INTEGER NOT NULL", "", "samples, or fragments of RTPS, sent there again"},
        {"fragments", "INTEGER NOT NULL", "", "of RTPS that the samples had"},
        {"bytes", "INTEGER NOT NULL", "byte", "of the samples, serialised"},
        {"latency_sum_ns", "INTEGER NOT NULL", "ns",
         "of those delivered, from the sender's interface to the receiver's"}},
       "writer, receiver"},
  };
}

std::vector<Table> sample_detail_tables() {
  return {
      {"sample_losses",
       "why samples were not delivered",
       {{"writer", "TEXT NOT NULL", "", "as in sample_sums"},
        {"receiver", "INTEGER NOT NULL", "", "agent"},
        {"verdict", "TEXT NOT NULL", "",
         "of the last data frame that carried what is missing of it and did not get on, at the hop "
         "where it ended: how its last attempt ended at the next radio; 'below sensitivity': that "
         "did not notice it; 'retry limit': it answered an RTS and was not heard; 'queue full', "
         "'expired', 'radio off' or 'no route' of what was not sent; 'not matched': it came before "
         "the receiver had been told of its writer; 'unknown': nothing of it was seen to be lost"},
        {"agent", "INTEGER NOT NULL", "",
         "whose frame or queue that was: the writer's agent or an access point; the receiver of "
         "'not matched', and of 'no route' if it was with no access point; 0: unknown"},
        {"count", "INTEGER NOT NULL", "", "samples"}},
       "writer, receiver, verdict, agent"},
      {"sample_latencies",
       "their latencies, in bins of 1/32 of their lower edge or less",
       {{"writer", "TEXT NOT NULL", "", "as in sample_sums"},
        {"receiver", "INTEGER NOT NULL", "", "agent"},
        {"least_ns", "INTEGER NOT NULL", "ns", "lower edge of the bin"},
        {"count", "INTEGER NOT NULL", "", "samples"}},
       "writer, receiver, least_ns"},
      {"samples",
       "samples one by one; only with record: {samples: all}",
       {{"writer", "TEXT NOT NULL", "", "GUID, as in dds_endpoints"},
        {"sequence_number", "INTEGER NOT NULL", "", "of the sample"},
        {"receiver", "INTEGER NOT NULL", "", "agent"},
        {"entered_ns", "INTEGER NOT NULL", "ns",
         "when its first packet left the sender's interface"},
        {"left_ns", "INTEGER", "ns", "when the last went into the receiver's; null: not delivered"},
        {"bytes", "INTEGER NOT NULL", "byte", "serialised"},
        {"fragments", "INTEGER NOT NULL", "", "of RTPS"},
        {"repairs", "INTEGER NOT NULL", "", "samples, or fragments, sent there again"},
        {"repaired", "INTEGER NOT NULL", "", "1: delivered thanks to these"},
        {"verdict", "TEXT", "", "as in sample_losses; null: delivered, or under way at the end"},
        {"frame", "INTEGER", "", "of that verdict, as in frames; null: it was in none"},
        {"lost_at", "INTEGER", "", "agent of that verdict, as in sample_losses; null: none"}},
       "writer, sequence_number, receiver"},
  };
}

std::vector<Table> air_views() {
  return {
      {"air_topics",
       "topics of programs: the outcome of their samples and their share of the air time",
       {{"topic", "TEXT", "", "name; null: not announced"},
        {"samples", "INTEGER", "", "times receivers, as in sample_sums"},
        {"delivered", "INTEGER", "", "of these"},
        {"first_try", "INTEGER", "", "of these"},
        {"repaired", "INTEGER", "", "delivered, not at the first try"},
        {"repairs", "INTEGER", "", "as in sample_sums"},
        {"submessages", "INTEGER", "", "of all kinds, retries included"},
        {"bits", "INTEGER", "bit", "as in air_accounts"},
        {"airtime_ns", "INTEGER", "ns", "as in air_accounts"},
        {"share", "", "", "share of the air time of all transmissions"}},
       "topic",
       "WITH sums AS (SELECT e.topic, SUM(s.samples) AS samples, SUM(s.delivered) AS delivered,"
       " SUM(s.first_try) AS first_try, SUM(s.repairs) AS repairs"
       " FROM sample_sums s JOIN dds_endpoints e ON e.guid = s.writer GROUP BY 1)"
       " SELECT a.topic, IFNULL(s.samples, 0) AS samples, IFNULL(s.delivered, 0) AS delivered,"
       " IFNULL(s.first_try, 0) AS first_try,"
       " IFNULL(s.delivered - s.first_try, 0) AS repaired, IFNULL(s.repairs, 0) AS repairs,"
       " SUM(a.submessages + a.repeated) AS submessages, SUM(a.bits) AS bits,"
       " SUM(a.airtime_ns) AS airtime_ns,"
       " 1.0 * SUM(a.airtime_ns) / MAX(1, (SELECT SUM(airtime_ns) FROM air_accounts)) AS share"
       " FROM air_accounts a LEFT JOIN sums s ON s.topic = a.topic WHERE a.purpose = 'user'"
       " GROUP BY a.topic"},
  };
}

std::vector<Table> kind_views() {
  return {
      {"air_kinds",
       "all transmissions, by kind",
       {{"purpose", "TEXT", "", "as in air_accounts"},
        {"kind", "TEXT", "", "as in air_accounts"},
        {"port", "INTEGER", "", "as in air_accounts"},
        {"frames", "INTEGER", "", "as in air_accounts"},
        {"retries", "INTEGER", "", "as in air_accounts"},
        {"submessages", "INTEGER", "", "as in air_accounts"},
        {"repeated", "INTEGER", "", "as in air_accounts"},
        {"bits", "INTEGER", "bit", "as in air_accounts"},
        {"airtime_ns", "INTEGER", "ns", "as in air_accounts"},
        {"share", "", "", "share of the air time of all transmissions"}},
       "purpose, kind, port",
       "SELECT purpose, kind, port, SUM(frames) AS frames, SUM(retries) AS retries,"
       " SUM(submessages) AS submessages, SUM(repeated) AS repeated, SUM(bits) AS bits,"
       " SUM(airtime_ns) AS airtime_ns,"
       " 1.0 * SUM(airtime_ns) / MAX(1, (SELECT SUM(airtime_ns) FROM air_accounts)) AS share"
       " FROM air_accounts GROUP BY 1, 2, 3"},
      {"air_link_verdicts",
       "outcome of frames by link, kind and topic; frames that no radio noticed are not included",
       {{"agent", "INTEGER", "", "receiver"},
        {"peer", "INTEGER", "", "transmitter"},
        {"purpose", "TEXT", "", "as in air_accounts"},
        {"kind", "TEXT", "", "as in air_accounts"},
        {"port", "INTEGER", "", "as in air_accounts"},
        {"topic", "TEXT", "", "as in air_accounts"},
        {"addressed", "INTEGER", "", "as in air_ends"},
        {"verdict", "TEXT", "", "as in air_ends"},
        {"frames", "INTEGER", "", "as in air_ends"},
        {"parts", "INTEGER", "", "as in air_ends"}},
       "agent, peer, purpose, kind, port, topic, addressed, verdict",
       "SELECT e.agent, a.agent AS peer, a.purpose, a.kind, a.port, a.topic, e.addressed, "
       "e.verdict,"
       " e.frames, e.parts FROM air_ends e JOIN air_accounts a USING (account)"},
  };
}

}  // namespace

std::vector<Table> ledger_tables() {
  std::vector<Table> sum;
  for (const auto& part : {air_account_tables(), writer_tables(), sample_tables(),
                           sample_detail_tables(), air_views(), kind_views()}) {
    sum.insert(sum.end(), part.begin(), part.end());
  }
  return sum;
}

}  // namespace results::record
