// What is in run.sqlite. The file is long because it is the list of it all.
#include "results/record/ledger_tables.h"
#include "results/record/observable_tables.h"
#include "results/record/relay_tables.h"
#include "results/record/schema.h"
#include "results/record/view_tables.h"

namespace results::record {
namespace {

std::vector<Table> setup_tables() {
  return {
      {"run",
       "one value per key: what was run and how it ended",
       {{"key", "TEXT NOT NULL", "", "see the keys of the table run"},
        {"value", "", "", "a number or a text"}},
       "key"},
      {"settings",
       "the resolved scenario, value by value, and --until and --pace of the command line",
       {{"key", "TEXT NOT NULL", "", "dotted path in scenario.resolved.yaml, items from 0"},
        {"value", "TEXT NOT NULL", "", "as written there, with its unit"}},
       "key"},
      {"agents",
       "who took part",
       {{"agent", "INTEGER PRIMARY KEY", "", "address"},
        {"name", "TEXT NOT NULL", "", "for people"},
        {"kind", "TEXT NOT NULL", "", "'mote', 'robot' or 'station'"},
        {"program", "TEXT NOT NULL", "", "controller"},
        {"x_m", "REAL NOT NULL", "m", "place at the start"},
        {"y_m", "REAL NOT NULL", "m", "place at the start"},
        {"theta_rad", "REAL NOT NULL", "rad", "heading at the start"}}},
      {"ends",
       "end conditions of the scenario",
       {{"agent", "INTEGER", "", "whose state ends the run; null: a condition or the time does"},
        {"state", "TEXT", "",
         "that this agent's controller enters; without an agent: the condition that ends the run; "
         "null: the time does"},
        {"after_ns", "INTEGER NOT NULL", "ns", "the end comes so long after, or at this time"},
        {"result", "TEXT NOT NULL", "", "what the run is then called"}}},
      {"walls",
       "boxes that never move, seen from above",
       {{"name", "TEXT NOT NULL", "", "for people"},
        {"x_m", "REAL NOT NULL", "m", "middle"},
        {"y_m", "REAL NOT NULL", "m", "middle"},
        {"yaw_rad", "REAL NOT NULL", "rad", "of its own x axis"},
        {"size_x_m", "REAL NOT NULL", "m", "length along its own x axis"},
        {"size_y_m", "REAL NOT NULL", "m", "length along its own y axis"}}},
      {"links",
       "pairs that can hear each other at the start",
       {{"a", "INTEGER NOT NULL", "", "the lower address"},
        {"b", "INTEGER NOT NULL", "", "the higher address"}}},
  };
}

std::vector<Table> possible_tables() {
  return {
      {"countable",
       "what this run could count: a count of such a word that no other table has is 0, a count of "
       "another does not exist in this run",
       {{"family", "TEXT NOT NULL", "",
         "of what, as the numbers of `baraka describe observables` begin: 'frames', 'receptions', "
         "'requests', 'messages.ends', 'routing.events', 'states', 'controllers'; without any row "
         "of frames or messages these were not counted"},
        {"program", "TEXT NOT NULL", "",
         "states, controllers: the controller that declares it, of the agents with that program; "
         "else ''"},
        {"word", "TEXT NOT NULL", "",
         "class, verdict, event, state or name, as other tables have it"}},
       "family, program, word"},
  };
}

std::vector<Table> count_tables() {
  return {
      {"frames_sent",
       "how many frames were sent",
       {{"agent", "INTEGER NOT NULL", "", "transmitter"},
        {"peer", "INTEGER NOT NULL", "", "receiver"},
        {"class", "TEXT NOT NULL", "",
         "'broadcast' or 'unicast' (data), 'rts', 'cts', 'ack', 'beacon', 'management' (the other "
         "management frames)"},
        {"count", "INTEGER NOT NULL", "", "frames"}},
       "agent, peer, class"},
      {"receptions",
       "how frames ended at the radios that could receive or sense them by themselves",
       {{"agent", "INTEGER NOT NULL", "", "receiver"},
        {"peer", "INTEGER NOT NULL", "", "transmitter"},
        {"class", "TEXT NOT NULL", "", "as in frames_sent"},
        {"addressed", "INTEGER NOT NULL", "", "1: to this agent or to everyone"},
        {"verdict", "TEXT NOT NULL", "", "how it ended"},
        {"count", "INTEGER NOT NULL", "", "receptions"}},
       "agent, peer, class, addressed, verdict"},
      {"associations",
       "with radio: {bss: ...}: which access point stations were with",
       {{"at_ns", "INTEGER NOT NULL", "ns", "since when"},
        {"station", "INTEGER NOT NULL", "", "agent"},
        {"access_point", "INTEGER", "", "agent; null: none"}}},
      {"faint",
       "interference: frames too weak for a radio to receive or sense, nothing else is said of "
       "them",
       {{"agent", "INTEGER PRIMARY KEY", "", "transmitter"},
        {"count", "INTEGER NOT NULL", "",
         "radios where a frame was above the interference floor only, over all its frames"}}},
      {"packets",
       "frames whose payload went up to the network layer",
       {{"agent", "INTEGER NOT NULL", "", "receiver"},
        {"peer", "INTEGER NOT NULL", "", "transmitter"},
        {"class", "TEXT NOT NULL", "", "'broadcast' or 'unicast'"},
        {"count", "INTEGER NOT NULL", "", "packets"}},
       "agent, peer, class"},
      {"requests",
       "how the link did with what it was asked to send; an access point also with what it took to "
       "pass on, see relays",
       {{"agent", "INTEGER NOT NULL", "", "sender"},
        {"peer", "INTEGER NOT NULL", "", "destination"},
        {"verdict", "TEXT NOT NULL", "",
         "how it ended; a broadcast that left the antenna is 'transmitted': the link cannot know "
         "who got it, receptions tells"},
        {"count", "INTEGER NOT NULL", "", "requests"}},
       "agent, peer, verdict"},
  };
}

std::vector<Table> air_tables() {
  return {
      {"in_the_air",
       "frames that had not ended at their transmitters when the totals were written, the last "
       "time "
       "at the end of the run",
       {{"agent", "INTEGER PRIMARY KEY", "", "transmitter"},
        {"peer", "INTEGER NOT NULL", "", "receiver"},
        {"class", "TEXT NOT NULL", "", "as in frames_sent"}}},
      {"in_the_air_ended",
       "radios at which such a frame had ended: it is in receptions",
       {{"agent", "INTEGER NOT NULL", "", "receiver"},
        {"peer", "INTEGER NOT NULL", "", "transmitter"}},
       "agent, peer"},
  };
}

/// Of the two views of what became of all that was sent.
constexpr std::string_view kDerived =
    "how it ended: as in receptions; 'below sensitivity' also if the radio did not notice it, be "
    "it "
    "on another channel, or only as interference (faint): all that was sent and is not recorded "
    "otherwise; 'under way': "
    "it was in the air at the end or, with propagation delay, had ended less than 1 ms before";

std::vector<Table> link_verdict_tables() {
  return {
      {"link_verdicts",
       "what became of each frame at each radio, for pairs of which one noticed a frame of the "
       "other, now or then: in sum, what the transmitter sent",
       {{"agent", "INTEGER", "", "receiver"},
        {"peer", "INTEGER", "", "transmitter"},
        {"class", "TEXT", "", "as in frames_sent"},
        {"addressed", "INTEGER", "", "1: to this agent or to everyone"},
        {"verdict", "TEXT", "", kDerived},
        {"count", "INTEGER", "", "frames"}},
       "agent, peer, class, addressed, verdict",
       "WITH pairs AS (SELECT DISTINCT agent, peer FROM receptions),"
       " sent AS (SELECT p.agent, p.peer, f.class, f.peer IN (p.agent, 65534, 65535) AS addressed,"
       " SUM(f.count) AS count FROM pairs p JOIN frames_sent f ON f.agent = p.peer"
       " GROUP BY 1, 2, 3, 4),"
       " ended AS (SELECT agent, peer, class, addressed, verdict, count FROM receptions"
       " UNION ALL SELECT p.agent, p.peer, a.class, a.peer IN (p.agent, 65534, 65535),"
       " 'under way', 1 FROM pairs p JOIN in_the_air a ON a.agent = p.peer"
       " WHERE NOT EXISTS (SELECT 1 FROM in_the_air_ended e"
       " WHERE e.agent = p.agent AND e.peer = p.peer)),"
       " told AS (SELECT agent, peer, class, addressed, SUM(count) AS count FROM ended"
       " GROUP BY 1, 2, 3, 4)"
       " SELECT agent, peer, class, addressed, verdict, SUM(count) AS count FROM ("
       "SELECT * FROM ended UNION ALL SELECT s.agent, s.peer, s.class, s.addressed,"
       " 'below sensitivity', s.count - IFNULL(t.count, 0) FROM sent s"
       " LEFT JOIN told t USING (agent, peer, class, addressed)"
       " WHERE s.count <> IFNULL(t.count, 0)) GROUP BY 1, 2, 3, 4, 5"},
  };
}

std::vector<Table> verdict_sum_tables() {
  return {
      {"verdict_sums",
       "what became of all frames at all other radios: in sum, frames sent times radios",
       {{"class", "TEXT", "", "as in frames_sent"},
        {"addressed", "INTEGER", "", "1: to this radio or to everyone"},
        {"verdict", "TEXT", "", kDerived},
        {"count", "INTEGER", "", "pairs of a frame and a radio"}},
       "class, addressed, verdict",
       "WITH others AS (SELECT COUNT(*) - 1 AS radios FROM agents),"
       // A CTS to oneself is addressed to no other radio.
       " possible AS (SELECT class, 1 AS addressed,"
       " SUM(count * CASE WHEN peer >= 65534 THEN radios ELSE peer <> agent END) AS count"
       " FROM frames_sent, others GROUP BY 1"
       " UNION ALL SELECT class, 0, SUM(count * (radios - (peer <> agent)))"
       " FROM frames_sent, others WHERE peer < 65534 GROUP BY 1),"
       " in_air AS (SELECT class, 1 AS addressed,"
       " SUM(CASE WHEN peer >= 65534 THEN radios ELSE peer <> agent END) AS count"
       " FROM in_the_air, others GROUP BY 1"
       " UNION ALL SELECT class, 0, SUM(radios - (peer <> agent)) FROM in_the_air, others"
       " WHERE peer < 65534 GROUP BY 1"
       " UNION ALL SELECT a.class, a.peer IN (e.agent, 65534, 65535), -COUNT(*)"
       " FROM in_the_air_ended e JOIN in_the_air a ON a.agent = e.peer GROUP BY 1, 2),"
       " ended AS (SELECT class, addressed, verdict, SUM(count) AS count FROM receptions"
       " GROUP BY 1, 2, 3"
       " UNION ALL SELECT class, addressed, 'under way', SUM(count) FROM in_air GROUP BY 1, 2),"
       " told AS (SELECT class, addressed, SUM(count) AS count FROM ended GROUP BY 1, 2)"
       " SELECT class, addressed, verdict, SUM(count) AS count FROM (SELECT * FROM ended"
       " UNION ALL SELECT p.class, p.addressed, 'below sensitivity', p.count - IFNULL(t.count, 0)"
       " FROM possible p LEFT JOIN told t USING (class, addressed))"
       " GROUP BY 1, 2, 3 HAVING SUM(count) <> 0"},
  };
}

std::vector<Table> message_tables() {
  return {
      {"messages",
       "what controllers sent; only with record: {messages: all}, the default up to 100 agents",
       {{"sender", "INTEGER NOT NULL", "", "agent"},
        {"id", "INTEGER NOT NULL", "", "of the message, by its sender"},
        {"destination", "INTEGER NOT NULL", "", "agent; 65535: everyone, 65534: neighbours"},
        {"topic", "TEXT NOT NULL", "", "class of the message"},
        {"bytes", "INTEGER NOT NULL", "byte", "payload"},
        {"sent_ns", "INTEGER NOT NULL", "ns", "when the controller sent it"},
        {"fate", "TEXT", "", "as told to the sender; null: nothing yet"},
        {"fate_ns", "INTEGER", "ns", "when it was told"},
        {"verdict", "TEXT", "",
         "how it ended; 'delivered' wins over the end of another copy; null: on its way at the "
         "end of the run; of a broadcast that nobody got: why most radios lost it, 'below "
         "sensitivity' if none was in range"}},
       "sender, id"},
      {"broadcasts",
       "of the listed messages those to everyone or to neighbours: how many got them",
       {{"sender", "INTEGER", "", "agent"},
        {"id", "INTEGER", "", "of the message, by its sender"},
        {"topic", "TEXT", "", "class of the message"},
        {"sent_ns", "INTEGER", "ns", "when the controller sent it"},
        {"addressees", "INTEGER", "", "all other agents"},
        {"reached", "INTEGER", "", "so many of them got it"},
        {"verdict", "TEXT", "", "as in messages"}},
       "sender, id",
       "SELECT sender, id, topic, sent_ns,"
       " (SELECT COUNT(*) FROM agents WHERE agent <> m.sender) AS addressees,"
       " (SELECT COUNT(*) FROM deliveries d WHERE d.sender = m.sender AND d.id = m.id) AS reached,"
       " verdict FROM messages m WHERE destination >= 65534"},
      {"deliveries",
       "listed messages handed to a controller; one to everyone or to neighbours once per agent",
       {{"sender", "INTEGER NOT NULL", "", "of the message"},
        {"id", "INTEGER NOT NULL", "", "of the message, by its sender"},
        {"receiver", "INTEGER NOT NULL", "", "agent"},
        {"at_ns", "INTEGER NOT NULL", "ns", "when"},
        {"delay_ns", "INTEGER NOT NULL", "ns", "since it was sent, waiting for a route included"},
        {"transmissions", "INTEGER", "", "on its way, the last hop included"}},
       "sender, id, receiver"},
  };
}

std::vector<Table> routing_tables() {
  return {
      {"discoveries",
       "searches for a route",
       {{"agent", "INTEGER NOT NULL", "", "who searched"},
        {"topic", "TEXT NOT NULL", "", "class of the messages"},
        {"destination", "INTEGER NOT NULL", "", "agent"},
        {"ended_ns", "INTEGER NOT NULL", "ns", "when"},
        {"took_ns", "INTEGER NOT NULL", "ns", "since the first message waited for it"},
        {"found", "INTEGER NOT NULL", "", "0: given up"}}},
      {"routing_events",
       "what the routing protocols did",
       {{"agent", "INTEGER NOT NULL", "", "whose router"},
        {"event", "TEXT NOT NULL", "", "'rreq sent', 'forward ant relayed', ..., by protocol"},
        {"count", "INTEGER NOT NULL", "", "so often"}},
       "agent, event"},
  };
}

std::vector<Table> counted_message_tables() {
  return {
      {"counted_ends",
       "messages that are not listed (record: {messages: counts}), by how they ended; read "
       "message_ends",
       {{"sender", "INTEGER NOT NULL", "", "agent"},
        {"destination", "INTEGER NOT NULL", "", "agent; 65535: everyone, 65534: neighbours"},
        {"topic", "TEXT NOT NULL", "", "class of the message"},
        {"verdict", "TEXT NOT NULL", "", "as in message_ends"},
        {"count", "INTEGER NOT NULL", "", "messages"},
        {"bytes", "INTEGER NOT NULL", "byte", "of their payloads"}},
       "sender, destination, topic, verdict"},
      {"counted_fates",
       "the same by what their senders were told; read message_fates",
       {{"sender", "INTEGER NOT NULL", "", "agent"},
        {"destination", "INTEGER NOT NULL", "", "agent; 65535: everyone, 65534: neighbours"},
        {"topic", "TEXT NOT NULL", "", "class of the message"},
        {"fate", "TEXT NOT NULL", "", "as told to the sender"},
        {"count", "INTEGER NOT NULL", "", "messages"}},
       "sender, destination, topic, fate"},
      {"counted_deliveries",
       "deliveries that are not listed; read message_deliveries",
       {{"sender", "INTEGER NOT NULL", "", "of the messages"},
        {"destination", "INTEGER NOT NULL", "", "agent; 65535: everyone, 65534: neighbours"},
        {"topic", "TEXT NOT NULL", "", "class of the messages"},
        {"receiver", "INTEGER NOT NULL", "", "agent"},
        {"transmissions", "INTEGER NOT NULL", "", "on their way, the last hop included"},
        {"count", "INTEGER NOT NULL", "", "deliveries"},
        {"bytes", "INTEGER NOT NULL", "byte", "of their payloads"},
        {"late", "INTEGER NOT NULL", "", "as in message_deliveries"},
        {"delay_sum_ns", "INTEGER NOT NULL", "ns", "as in message_deliveries"},
        {"delay_least_ns", "INTEGER", "ns", "the shortest; null: all were late"},
        {"delay_greatest_ns", "INTEGER", "ns", "the longest; null: all were late"}},
       "sender, destination, topic, receiver, transmissions"},
  };
}

/// What holds whether messages are listed or counted.
std::vector<Table> message_sum_tables() {
  return {
      {"message_ends",
       "how messages ended, whether they are listed or counted; all that were sent are in the sum",
       {{"sender", "INTEGER", "", "agent"},
        {"destination", "INTEGER", "", "agent, or everyone"},
        {"topic", "TEXT", "", "class of the message"},
        {"verdict", "TEXT", "", "as in messages; 'under way': on its way at the end of the run"},
        {"count", "INTEGER", "", "messages"},
        {"bytes", "INTEGER", "byte", "of their payloads"}},
       "sender, destination, topic, verdict",
       "SELECT sender, destination, topic, IFNULL(verdict, 'under way') AS verdict,"
       " COUNT(*) AS count, SUM(bytes) AS bytes FROM messages GROUP BY 1, 2, 3, 4"
       " UNION ALL SELECT sender, destination, topic, verdict, count, bytes FROM counted_ends"
       " WHERE count > 0"},
      {"message_fates",
       "what senders were told of their messages, whether they are listed or counted",
       {{"sender", "INTEGER", "", "agent"},
        {"destination", "INTEGER", "", "agent, or everyone"},
        {"topic", "TEXT", "", "class of the message"},
        {"fate", "TEXT", "", "as told to the sender"},
        {"count", "INTEGER", "", "messages"}},
       "sender, destination, topic, fate",
       "SELECT sender, destination, topic, fate, COUNT(*) AS count FROM messages"
       " WHERE fate IS NOT NULL GROUP BY 1, 2, 3, 4"
       " UNION ALL SELECT sender, destination, topic, fate, count FROM counted_fates"},
  };
}

std::vector<Table> delivery_sum_tables() {
  return {
      {"message_deliveries",
       "messages handed to controllers, whether they are listed or counted",
       {{"sender", "INTEGER", "", "of the messages"},
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
       "SELECT m.sender, m.destination, m.topic, d.receiver, d.transmissions, COUNT(*) AS count,"
       " SUM(m.bytes) AS bytes, 0 AS late, SUM(d.delay_ns) AS delay_sum_ns,"
       " MIN(d.delay_ns) AS delay_least_ns, MAX(d.delay_ns) AS delay_greatest_ns"
       " FROM deliveries d JOIN messages m USING (sender, id) GROUP BY 1, 2, 3, 4, 5"
       " UNION ALL SELECT * FROM counted_deliveries"},
      {"broadcast_sums",
       "the messages to everyone or to neighbours, whether they are listed or counted: how many "
       "were sent and got",
       {{"sender", "INTEGER", "", "agent"},
        {"topic", "TEXT", "", "class of the message"},
        {"messages", "INTEGER", "", "sent"},
        {"addressees", "INTEGER", "", "of all of them together: all other agents, each time"},
        {"reached", "INTEGER", "", "so many of those got theirs"}},
       "sender, topic",
       "SELECT e.sender, e.topic, SUM(e.count) AS messages,"
       " SUM(e.count) * (SELECT COUNT(*) FROM agents WHERE agent <> e.sender) AS addressees,"
       " IFNULL(d.reached, 0) AS reached"
       " FROM message_ends e LEFT JOIN (SELECT sender, topic, SUM(count) AS reached"
       " FROM message_deliveries WHERE destination >= 65534 GROUP BY 1, 2) d"
       " ON d.sender = e.sender AND d.topic = e.topic WHERE e.destination >= 65534 GROUP BY 1, 2"},
  };
}

std::vector<Table> body_tables() {
  return {
      {"poses",
       "where agents were: once per period (record: pose_period), and only if one moved since",
       {{"agent", "INTEGER NOT NULL", "", "who"},
        {"at_ns", "INTEGER NOT NULL", "ns", "when"},
        {"x_m", "REAL NOT NULL", "m", "place"},
        {"y_m", "REAL NOT NULL", "m", "place"},
        {"theta_rad", "REAL NOT NULL", "rad", "heading"}},
       "agent, at_ns"},
      {"bodies",
       "figures of the whole run, seen at each control instant",
       {{"agent", "INTEGER PRIMARY KEY", "", "who"},
        {"path_m", "REAL NOT NULL", "m", "travelled"},
        {"clearance_m", "REAL", "m",
         "least distance of the centre to a wall's surface; null: no wall"},
        {"tilt_rad", "REAL NOT NULL", "rad", "greatest"},
        {"x_m", "REAL NOT NULL", "m", "last place"},
        {"y_m", "REAL NOT NULL", "m", "last place"},
        {"theta_rad", "REAL NOT NULL", "rad", "last heading"},
        {"wall_steps", "INTEGER", "",
         "physics steps in contact with a wall; null until the run has ended"},
        {"object_steps", "INTEGER", "",
         "physics steps in contact with another body; null until the run has ended"}}},
      {"lost_bodies",
       "bodies that tipped over (tilt above 1 rad) or left the world",
       {{"agent", "INTEGER PRIMARY KEY", "", "who"},
        {"at_ns", "INTEGER NOT NULL", "ns", "when"},
        {"what", "TEXT NOT NULL", "", "'tipped over' or how it was lost"}}},
  };
}

std::vector<Table> controller_tables() {
  return {
      {"states",
       "states that controllers named",
       {{"agent", "INTEGER NOT NULL", "", "whose controller"},
        {"at_ns", "INTEGER NOT NULL", "ns", "when it was entered"},
        {"state", "TEXT NOT NULL", "", "as the controller calls it"}}},
      {"events",
       "what happened because the scenario's `events` say so",
       {{"at_ns", "INTEGER NOT NULL", "ns", "when"},
        {"event", "INTEGER NOT NULL", "", "index in `events` of the scenario, from 0"},
        {"action", "TEXT NOT NULL", "", "as in the scenario: 'kill', 'switch_off', 'jam'"},
        {"agent", "INTEGER", "", "to whom; null: to the air"}}},
      {"recorded",
       "numbers that controllers recorded",
       {{"agent", "INTEGER NOT NULL", "", "whose controller"},
        {"at_ns", "INTEGER NOT NULL", "ns", "of the event in which it was recorded"},
        {"name", "TEXT NOT NULL", "", "as the controller calls it"},
        {"value", "REAL NOT NULL", "", "in the unit of recorded_units, if it has one there"}}},
      {"recorded_units",
       "units of what controllers record, as they declare them",
       {{"program", "TEXT NOT NULL", "", "the controller, as in agents"},
        {"name", "TEXT NOT NULL", "", "as in recorded"},
        {"unit", "TEXT NOT NULL", "", "'m', or '1': a count or a share"}},
       "program, name"},
  };
}

std::vector<Table> use_tables() {
  return {
      {"agent_use",
       "what agents used, written at the end of the run",
       {{"agent", "INTEGER PRIMARY KEY", "", "who"},
        {"transmitting_ns", "INTEGER NOT NULL", "ns", "its radio sent"},
        {"receiving_ns", "INTEGER NOT NULL", "ns",
         "its radio found the medium busy by others; 0 with profiles without a MAC"},
        {"listening_ns", "INTEGER NOT NULL", "ns", "its radio found the medium idle"},
        {"off_ns", "INTEGER NOT NULL", "ns", "its radio was off"},
        {"retries", "INTEGER", "", "frames that it sent again; null with record: {frames: none}"},
        {"energy_j", "REAL", "J",
         "drawn from its battery by computer, radio and motors, with the heat in the battery: "
         "never "
         "more than it held; null: it has no battery"},
        {"load_j", "REAL", "J",
         "asked for by computer, radio and motors, also of a battery that was empty; null: it has "
         "no battery"}}},
  };
}

std::vector<Table> program_tables() {
  return {
      {"interfaces",
       "frames between programs with sockets and the air, for agents that have a network",
       {{"agent", "INTEGER NOT NULL", "", "whose interface"},
        {"what", "TEXT NOT NULL", "",
         "'entered': from a program to the station's queue; 'left': from the air to the programs; "
         "'refused: ...': from a program, not to be sent by a radio, and why"},
        {"frames", "INTEGER NOT NULL", "", "so many"},
        {"bytes", "INTEGER NOT NULL", "byte",
         "IP packets or ARP; refused: with the Ethernet header"}},
       "agent, what"},
      {"programs",
       "programs that the scenario started inside agents",
       {{"agent", "INTEGER NOT NULL", "", "inside whom"},
        {"name", "TEXT NOT NULL", "", "as the scenario calls it"},
        {"started_ns", "INTEGER NOT NULL", "ns", "when"},
        {"ended_ns", "INTEGER", "ns", "when; null: it was ended with the run"},
        {"status", "INTEGER", "", "exit status; 128 + signal if one ended it; null: as above"}}},
  };
}

std::vector<Table> trace_tables() {
  return {
      {"turns",
       "in real time: when a controller process had an influence",
       {{"at_ns", "INTEGER NOT NULL", "ns", "all events up to this time had run"},
        {"process", "INTEGER NOT NULL", "",
         "controller processes in order of their lowest agent, from 0"},
        {"replied", "INTEGER NOT NULL", "", "1: its answer took effect ..."},
        {"began", "INTEGER NOT NULL", "", "1: ... and then it was given what waited"}}},
      {"arrivals",
       "what came into the run from outside and does not follow from scenario and seed",
       {{"at_ns", "INTEGER NOT NULL", "ns",
         "when it was taken in: in real time after the events of that time, in lock-step before"},
        {"door", "TEXT NOT NULL", "", "what it is for: 'cmd_vel of r0', 'air of r0', 'programs'"},
        {"bytes", "TEXT NOT NULL", "",
         "hexadecimal; cmd_vel: m/s forward, m/s left, rad/s as binary64, little-endian; air: the "
         "Ethernet frame; programs: how one ended the run"}}},
      {"fingerprints",
       "hashes of what was observed, per part, agent and second, where they change from one second "
       "to the next: two runs differ first where these rows do",
       {{"second", "INTEGER NOT NULL", "", "number of the simulated second, from 0"},
        {"part", "TEXT NOT NULL", "", "'air', 'bodies', 'exchange' or 'routing'"},
        {"agent", "INTEGER NOT NULL", "", "who"},
        {"hash", "INTEGER", "",
         "64 bits, of this second and those that follow until the next row of the part and agent; "
         "times are counted within the second; null: nothing was observed"}},
       "second, part, agent"},
  };
}

}  // namespace

std::string_view conventions() {
  return "Times are simulated and count from the start of the run. Lengths and angles are in the "
         "world frame: x and y in the plane, headings from the x axis towards the y axis. Agents "
         "are addresses; 65535 is everyone, 65534 whoever hears it. Verdicts are: delivered, below "
         "sensitivity, preamble "
         "missed, collision, interference, noise, obstacle, retry limit, queue full, receiver "
         "transmitting, radio off, no route, expired, agent down, random loss. Fates are: handed "
         "over, no "
         "route, queue full, failed.";
}

const std::vector<Table>& tables() {
  static const std::vector<Table> all = [] {
    std::vector<Table> sum;
    for (const auto& part : {setup_tables(),       possible_tables(),     count_tables(),
                             air_tables(),         link_verdict_tables(), verdict_sum_tables(),
                             message_tables(),     routing_tables(),      counted_message_tables(),
                             message_sum_tables(), delivery_sum_tables(), ledger_tables(),
                             observable_tables(),  body_tables(),         controller_tables(),
                             use_tables(),         program_tables(),      look_tables(),
                             trace_tables(),       frame_tables(),        relay_tables()}) {
      sum.insert(sum.end(), part.begin(), part.end());
    }
    return sum;
  }();
  return all;
}

}  // namespace results::record
