// The tables of run.sqlite that hold the ledger of the air.
#include "results/record/ledger_tables.h"

namespace results::record {
namespace {

std::vector<Table> air_account_tables() {
  return {
      {"air_accounts",
       "if an agent has a network: use of the air by kind of traffic. Bits and air time of a frame "
       "are divided among its contents in proportion to their bytes, headers and preamble included "
       "(rounding by largest remainders). The frame itself counts once, for its largest part (the "
       "first of equal ones). So the sums over all accounts of an agent are those of its radio",
       {{"account", "INTEGER PRIMARY KEY", "", "number"},
        {"agent", "INTEGER NOT NULL", "", "transmitter"},
        {"purpose", "TEXT NOT NULL", "",
         "what it is for. RTPS: 'user' (topics of programs), 'SPDP', 'SEDP', 'liveliness', "
         "'builtin' (other endpoints of the middleware), 'RTPS' (no endpoint); other frames: "
         "'network' (other traffic of programs), 'routing', '802.11' (control and management "
         "frames), 'other'"},
        {"kind", "TEXT NOT NULL", "",
         "RTPS: the submessage ('vendor 0x80' if it is specific to a vendor); 'ARP', 'ICMP', "
         "'IGMP', 'ICMPv6', 'TCP', 'UDP', 'IP 132', 'fragments' (the first of which was not seen), "
         "'malformed'; 'ack', 'rts', 'beacon', ...; else the Ethertype"},
        {"port", "INTEGER", "",
         "TCP, and UDP other than RTPS: the lower one of the two ports; null: both are 32768 or "
         "higher"},
        {"topic", "TEXT", "",
         "with 'user': the topic, as announced by SEDP on the air; null: not announced yet"},
        {"frames", "INTEGER NOT NULL", "", "frames whose largest part is of this kind"},
        {"retries", "INTEGER NOT NULL", "", "retransmissions among these frames"},
        {"submessages", "INTEGER NOT NULL", "",
         "submessages that begin in first transmissions of frames; for traffic without "
         "submessages: frames"},
        {"repeated", "INTEGER NOT NULL", "", "submessages that begin in retransmissions"},
        {"bits", "INTEGER NOT NULL", "bit", "share of the frames' lengths on the air"},
        {"airtime_ns", "INTEGER NOT NULL", "ns", "share of the time on the air"}}},
      {"air_ends",
       "outcome of the frames of air_accounts at the radios that could receive or sense them",
       {{"account", "INTEGER NOT NULL", "", "as in air_accounts"},
        {"agent", "INTEGER NOT NULL", "", "receiver"},
        {"addressed", "INTEGER NOT NULL", "", "1: to this agent or to everyone"},
        {"verdict", "TEXT NOT NULL", "", "outcome"},
        {"frames", "INTEGER NOT NULL", "",
         "frames, counted as in air_accounts; their sum is that of receptions"},
        {"parts", "INTEGER NOT NULL", "",
         "items of this kind that these frames carried in whole or in part"}},
       "account, agent, addressed, verdict"},
  };
}

std::vector<Table> writer_tables() {
  return {
      {"air_writers",
       "the same by DDS writer: submessages from it, and ACKNACK and NACK_FRAG to it",
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
        {"airtime_ns", "INTEGER NOT NULL", "ns",
         "air time of the frames that began in this second"}},
       "second, purpose, kind"},
  };
}

std::vector<Table> sample_tables() {
  return {
      {"dds_endpoints",
       "writers and readers announced by SEDP on the air",
       {{"guid", "TEXT PRIMARY KEY", "", "hexadecimal"},
        {"agent", "INTEGER", "", "agent whose programs contain it; null: they have sent no frame"},
        {"kind", "TEXT NOT NULL", "", "'writer' or 'reader'"},
        {"topic", "TEXT NOT NULL", "", "name"},
        {"type", "TEXT NOT NULL", "", "name"},
        {"reliability", "TEXT NOT NULL", "", "'reliable' or 'best effort'"},
        {"durability", "TEXT NOT NULL", "", "'volatile', 'transient local', ..."},
        {"told_ns", "INTEGER", "ns", "when it was first announced"}}},
      {"sample_sums",
       "samples of the programs' writers at other agents with a matched reader, that is: when a "
       "sample was first sent, topic, type, reliability, durability and partition were compatible, "
       "and the SEDP announcement of each side had reached the other. Not with record: {samples: "
       "none}",
       {{"writer", "TEXT NOT NULL", "", "GUID, as in dds_endpoints"},
        {"receiver", "INTEGER NOT NULL", "", "agent"},
        {"samples", "INTEGER NOT NULL", "",
         "samples sent; the outcome is final 10 s after the last transmission"},
        {"delivered", "INTEGER NOT NULL", "",
         "samples that arrived at the receiver's interface completely"},
        {"first_try", "INTEGER NOT NULL", "",
         "delivered without DDS having sent any part of the sample again; retransmissions of "
         "802.11 do not count as such"},
        {"under_way", "INTEGER NOT NULL", "",
         "samples neither delivered nor lost at the end of the run"},
        {"repairs", "INTEGER NOT NULL", "",
         "samples, or RTPS fragments, that DDS sent to this receiver again"},
        {"fragments", "INTEGER NOT NULL", "", "RTPS fragments of the samples"},
        {"bytes", "INTEGER NOT NULL", "byte", "serialised size of the samples"},
        {"latency_sum_ns", "INTEGER NOT NULL", "ns",
         "sum of the latencies of delivered samples, from the sender's interface to the "
         "receiver's"}},
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
         "why the last data frame with a missing part of the sample went no further: outcome of "
         "its last transmission at the radio of the next hop; 'below sensitivity': that radio did "
         "not sense it; 'retry limit': that radio answered an RTS, but the answer was not "
         "received; 'queue full', 'expired', 'radio off', 'no route': it was not sent; 'not "
         "matched': it arrived before the receiver knew the writer; 'unknown': no loss was seen"},
        {"agent", "INTEGER NOT NULL", "",
         "agent whose frame or queue it was: that of the writer, or an access point; with 'not "
         "matched', and with 'no route' because the receiver was not associated, the receiver; 0: "
         "unknown"},
        {"count", "INTEGER NOT NULL", "", "samples"}},
       "writer, receiver, verdict, agent"},
      {"sample_latencies",
       "latencies of delivered samples as a histogram; a bin is at most 1/32 of its lower edge "
       "wide",
       {{"writer", "TEXT NOT NULL", "", "as in sample_sums"},
        {"receiver", "INTEGER NOT NULL", "", "agent"},
        {"least_ns", "INTEGER NOT NULL", "ns", "lower edge of the bin"},
        {"count", "INTEGER NOT NULL", "", "samples"}},
       "writer, receiver, least_ns"},
      {"samples",
       "samples one by one; only with record: {samples: all}",
       {{"writer", "TEXT NOT NULL", "", "GUID, as in dds_endpoints"},
        {"sequence_number", "INTEGER NOT NULL", "", "number of the sample"},
        {"receiver", "INTEGER NOT NULL", "", "agent"},
        {"entered_ns", "INTEGER NOT NULL", "ns",
         "when its first packet left the sender's interface"},
        {"left_ns", "INTEGER", "ns", "when the last went into the receiver's; null: not delivered"},
        {"bytes", "INTEGER NOT NULL", "byte", "serialised size"},
        {"fragments", "INTEGER NOT NULL", "", "RTPS fragments of the sample"},
        {"repairs", "INTEGER NOT NULL", "",
         "samples, or RTPS fragments, that DDS sent to this receiver again"},
        {"repaired", "INTEGER NOT NULL", "", "1: delivered with the help of these"},
        {"verdict", "TEXT", "", "as in sample_losses; null: delivered, or under way at the end"},
        {"frame", "INTEGER", "",
         "frame to which the verdict applies, as in frames; null: no frame"},
        {"lost_at", "INTEGER", "",
         "agent to which the verdict applies, as in sample_losses; null: none"}},
       "writer, sequence_number, receiver"},
  };
}

std::vector<Table> air_views() {
  return {
      {"air_topics",
       "topics of programs: the outcome of their samples and their share of the air time",
       {{"topic", "TEXT", "", "name; null: not announced"},
        {"samples", "INTEGER", "", "samples times receivers, as in sample_sums"},
        {"delivered", "INTEGER", "", "samples among these"},
        {"first_try", "INTEGER", "", "samples among these"},
        {"repaired", "INTEGER", "", "delivered samples of which DDS sent parts again"},
        {"repairs", "INTEGER", "", "as in sample_sums"},
        {"submessages", "INTEGER", "", "submessages of all kinds, in retransmissions too"},
        {"bits", "INTEGER", "bit", "as in air_accounts"},
        {"airtime_ns", "INTEGER", "ns", "as in air_accounts"},
        {"share", "", "", "share of the air time of all transmissions"}},
       "topic",
       "WITH sums AS (SELECT e.topic, SUM(s.samples) AS samples, SUM(s.delivered) AS delivered, "
       "SUM(s.first_try) AS first_try, SUM(s.repairs) AS repairs FROM sample_sums s JOIN "
       "dds_endpoints e ON e.guid = s.writer GROUP BY 1) SELECT a.topic, IFNULL(s.samples, 0) AS "
       "samples, IFNULL(s.delivered, 0) AS delivered, IFNULL(s.first_try, 0) AS first_try, "
       "IFNULL(s.delivered - s.first_try, 0) AS repaired, IFNULL(s.repairs, 0) AS repairs, "
       "SUM(a.submessages + a.repeated) AS submessages, SUM(a.bits) AS bits, SUM(a.airtime_ns) AS "
       "airtime_ns, 1.0 * SUM(a.airtime_ns) / MAX(1, (SELECT SUM(airtime_ns) FROM air_accounts)) "
       "AS share FROM air_accounts a LEFT JOIN sums s ON s.topic = a.topic WHERE a.purpose = "
       "'user' GROUP BY a.topic"},
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
       "SELECT purpose, kind, port, SUM(frames) AS frames, SUM(retries) AS retries, "
       "SUM(submessages) AS submessages, SUM(repeated) AS repeated, SUM(bits) AS bits, "
       "SUM(airtime_ns) AS airtime_ns, 1.0 * SUM(airtime_ns) / MAX(1, (SELECT SUM(airtime_ns) FROM "
       "air_accounts)) AS share FROM air_accounts GROUP BY 1, 2, 3"},
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
       "e.verdict, e.frames, e.parts FROM air_ends e JOIN air_accounts a USING (account)"},
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
