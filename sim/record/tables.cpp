// What is in run.sqlite. The file is long because it is the list of it all.
#include "sim/record/schema.h"

namespace sim::record {
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
       {{"agent", "INTEGER", "", "whose state ends the run; null: the time does"},
        {"state", "TEXT", "", "that this agent's controller enters; null: the time ends the run"},
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
       "how the link did with what it was asked to send",
       {{"agent", "INTEGER NOT NULL", "", "sender"},
        {"peer", "INTEGER NOT NULL", "", "destination"},
        {"verdict", "TEXT NOT NULL", "",
         "how it ended; a broadcast that left the antenna is 'transmitted': the link cannot know "
         "who got it, receptions tells"},
        {"count", "INTEGER NOT NULL", "", "requests"}},
       "agent, peer, verdict"},
  };
}

std::vector<Table> message_tables() {
  return {
      {"messages",
       "what controllers sent",
       {{"sender", "INTEGER NOT NULL", "", "agent"},
        {"id", "INTEGER NOT NULL", "", "of the message, by its sender"},
        {"destination", "INTEGER NOT NULL", "", "agent, or everyone"},
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
       "the messages to everyone or to neighbours: how many got them",
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
       "messages handed to a controller; a flood once per agent",
       {{"sender", "INTEGER NOT NULL", "", "of the message"},
        {"id", "INTEGER NOT NULL", "", "of the message, by its sender"},
        {"receiver", "INTEGER NOT NULL", "", "agent"},
        {"at_ns", "INTEGER NOT NULL", "ns", "when"},
        {"delay_ns", "INTEGER NOT NULL", "ns", "since it was sent, waiting for a route included"},
        {"transmissions", "INTEGER", "", "on its way, the last hop included"}},
       "sender, id, receiver"},
      {"discoveries",
       "searches for a route",
       {{"agent", "INTEGER NOT NULL", "", "who searched"},
        {"topic", "TEXT NOT NULL", "", "class of the messages"},
        {"destination", "INTEGER NOT NULL", "", "agent"},
        {"ended_ns", "INTEGER NOT NULL", "ns", "when"},
        {"took_ns", "INTEGER NOT NULL", "ns", "since the first message waited for it"},
        {"found", "INTEGER NOT NULL", "", "0: given up"}}},
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
      {"states",
       "states that controllers named",
       {{"agent", "INTEGER NOT NULL", "", "whose controller"},
        {"at_ns", "INTEGER NOT NULL", "ns", "when it was entered"},
        {"state", "TEXT NOT NULL", "", "as the controller calls it"}}},
      {"recorded",
       "numbers that controllers recorded",
       {{"agent", "INTEGER NOT NULL", "", "whose controller"},
        {"at_ns", "INTEGER NOT NULL", "ns", "of the event in which it was recorded"},
        {"name", "TEXT NOT NULL", "", "as the controller calls it"},
        {"value", "REAL NOT NULL", "", "in the controller's unit"}}},
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
        {"door", "TEXT NOT NULL", "", "what it is for: 'cmd_vel of r0'"},
        {"bytes", "TEXT NOT NULL", "",
         "hexadecimal; cmd_vel: m/s forward, m/s left, rad/s as binary64, little-endian"}}},
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
      {"frames",
       "each frame; only with record: {frames: all}",
       {{"frame", "INTEGER PRIMARY KEY", "", "number"},
        {"at_ns", "INTEGER NOT NULL", "ns", "when it began"},
        {"class", "TEXT NOT NULL", "", "as in frames_sent"},
        {"transmitter", "INTEGER NOT NULL", "", "agent"},
        {"receiver", "INTEGER NOT NULL", "", "agent, or everyone"},
        {"sequence", "INTEGER NOT NULL", "", "number that the transmitter gave it"},
        {"retry", "INTEGER NOT NULL", "", "1: it was sent before"},
        {"bits", "INTEGER NOT NULL", "bit", "length on the air"},
        {"airtime_ns", "INTEGER NOT NULL", "ns", "from its begin to its end"}}},
      {"frame_ends",
       "each reception; only with record: {frames: all}",
       {{"frame", "INTEGER NOT NULL", "", "number"},
        {"agent", "INTEGER NOT NULL", "", "receiver"},
        {"at_ns", "INTEGER NOT NULL", "ns", "when it ended there"},
        {"verdict", "TEXT NOT NULL", "", "how"},
        {"rssi_dbm", "REAL", "dBm", "power received"}}},
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
    for (const auto& part :
         {setup_tables(), count_tables(), message_tables(), body_tables(), trace_tables()}) {
      sum.insert(sum.end(), part.begin(), part.end());
    }
    return sum;
  }();
  return all;
}

const std::vector<RunKey>& run_keys() {
  static const std::vector<RunKey> keys = {
      {"run_id", "", "128 random bits; the marker of the folder has them, too"},
      {"result", "",
       "'running' until the run has ended; then as the scenario calls it, 'until', 'interrupted', "
       "'failed', or 'not started'"},
      {"error", "", "why it failed or did not start"},
      {"exit_status", "", "of the program; not there until the run has ended"},
      {"scenario", "", "its name"},
      {"version", "", "of baraka"},
      {"seed", "", "of the random streams"},
      {"profile", "", "of the radio"},
      {"pace", "", "'lockstep', 'realtime', 'realtime:<factor>', or 'repeated' from a record"},
      {"controller_latency_s", "s", "until an action takes effect"},
      {"control_phase", "", "'aligned' or 'uniform'"},
      {"control_period_s", "s", "of the scenario"},
      {"ended_ns", "ns", "simulated time"},
      {"simulated_s", "s", "the same"},
      {"wall_s", "s", "real time from START to the last event"},
      {"events", "", "of the simulator"},
      {"exchanges", "", "with controllers"},
      {"refused_actions", "", "of controllers, dropped"},
      {"ode_messages", "", "complaints of the physics engine"},
      {"fingerprint", "", "of everything observed, 64 bits in hexadecimal"},
      {"fingerprint_air", "", "of frames and receptions"},
      {"fingerprint_bodies", "", "of poses at control instants"},
      {"fingerprint_exchange", "", "of events and actions"},
      {"fingerprint_routing", "", "of route changes"},
      {"overruns", "", "in real time: steps that came too late"},
      {"missed_cycles", "", "in real time: control cycles without an answer in time"},
      {"command_timeouts", "", "in real time: wheels stopped for want of an action"},
      {"lost_events", "", "in real time: found no room while a controller was busy"},
      {"control_jitter_median_s", "s", "in real time: lateness of control cycles"},
      {"control_jitter_p99_s", "s", "99 % are not later"},
      {"control_jitter_max_s", "s", "greatest"},
  };
  return keys;
}

}  // namespace sim::record
