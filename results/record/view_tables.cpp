#include "results/record/view_tables.h"

namespace results::record {

std::vector<Table> look_tables() {
  return {
      {"routes",
       "changes of agents' routing tables; only with record: {routes: all}, the default up to 100 "
       "agents",
       {{"agent", "INTEGER NOT NULL", "", "whose table"},
        {"at_ns", "INTEGER NOT NULL", "ns", "when"},
        {"topic", "TEXT NOT NULL", "", "class of the messages"},
        {"destination", "INTEGER NOT NULL", "", "agent"},
        {"next_hop", "INTEGER NOT NULL", "", "agent"},
        {"hops", "INTEGER", "", "of the path; null, as all that follows: the entry is gone"},
        {"delay_ns", "INTEGER", "ns", "expected, of the path"},
        {"min_snr_db", "REAL", "dB", "of its weakest link"},
        {"energy_j", "REAL", "J", "to send one packet along it"},
        {"weight", "REAL", "",
         "r(n)^beta of equation 1 of the paper: a message takes this next hop with this share of "
         "the "
         "sum over the next hops of its topic and destination; null: the protocol chooses "
         "otherwise"}}},
      {"readings",
       "what sensors said, with record: {readings: ranges | all}: a row per pose_period at most, "
       "and "
       "only if a channel says something else",
       {{"agent", "INTEGER NOT NULL", "", "whose"},
        {"at_ns", "INTEGER NOT NULL", "ns", "control instant"},
        {"channel", "TEXT NOT NULL", "", "name: 'infrared', 'odometry', ..."},
        {"reading", "TEXT NOT NULL", "",
         "its values, with a space between, six digits; - for none (nothing within reach)"}}},
      {"queues",
       "frames that wait at an agent's radio, looked at when it begins to send one and when it is "
       "done with one, if they are more or fewer than before; as routes",
       {{"agent", "INTEGER NOT NULL", "", "whose"},
        {"at_ns", "INTEGER NOT NULL", "ns", "when"},
        {"frames", "INTEGER NOT NULL", "", "that wait or are being sent"}}},
      {"contacts",
       "when a body began to touch something: seen at a row of its in poses, and not at the one "
       "before",
       {{"agent", "INTEGER NOT NULL", "", "whose body"},
        {"at_ns", "INTEGER NOT NULL", "ns", "control instant"},
        {"other", "TEXT NOT NULL", "", "'wall', or 'body' of another agent"}}},
  };
}

std::vector<Table> frame_tables() {
  return {
      {"frames",
       "frames one by one: each with record: {frames: all}, with `sample` the first of each "
       "simulated "
       "second, until they and how they ended are 5000 rows",
       {{"frame", "INTEGER NOT NULL", "", "transmitter times 2^48 and its own count"},
        {"at_ns", "INTEGER NOT NULL", "ns", "when it began"},
        {"class", "TEXT NOT NULL", "", "as in frames_sent"},
        {"transmitter", "INTEGER NOT NULL", "", "agent"},
        {"receiver", "INTEGER NOT NULL", "", "agent, or everyone"},
        {"sequence", "INTEGER NOT NULL", "", "number that the transmitter gave it"},
        {"retry", "INTEGER NOT NULL", "", "1: it was sent before"},
        {"bits", "INTEGER NOT NULL", "bit", "length on the air"},
        {"airtime_ns", "INTEGER NOT NULL", "ns", "from its begin to its end"},
        {"duration_ns", "INTEGER NOT NULL", "ns",
         "its Duration field: how long others keep still after it"},
        {"rate_bps", "INTEGER", "bit/s", "of the MPDU; null: the radio has none"},
        {"sender", "INTEGER", "", "of the controllers' message that it carries; null: none"},
        {"message", "INTEGER", "", "number of that message, by its sender"},
        {"packet", "TEXT", "",
         "what routing sent in it: 'data', 'forward ant', ...; null: nothing"}}},
      {"frame_ends",
       "how the frames of the table frames ended at the radios that could receive or sense them",
       {{"frame", "INTEGER NOT NULL", "", "as in frames"},
        {"agent", "INTEGER NOT NULL", "", "receiver"},
        {"at_ns", "INTEGER NOT NULL", "ns", "when it ended there"},
        {"verdict", "TEXT NOT NULL", "", "how"},
        {"rssi_dbm", "REAL", "dBm", "power received"},
        {"sinr_db", "REAL", "dB",
         "lowest over the frame; null: the radio was not synchronised to it"}}},
  };
}

}  // namespace results::record
