#pragma once

#include <fmt/format.h>

#include "sim/record/database.h"

namespace sim::record {

/// Version of the tables below, as `PRAGMA user_version` of the file.
inline constexpr int kSchemaVersion = 3;

/// The tables of `run.sqlite`. SQLite keeps the comments: `sqlite3 run.sqlite .schema` shows this
/// text. Times are simulated nanoseconds since the start of the run, lengths metres, angles
/// radians in the world frame; agents are addresses, 65535 is everyone. Verdicts and fates are
/// named as in hal/types.
inline constexpr const char* kSchema = R"sql(
CREATE TABLE run (           -- one value per key: scenario, version, seed, profile, result, error,
  key TEXT PRIMARY KEY,      -- simulated_s, wall_s, events, exchanges, fingerprint, ...
  value                      -- result is 'running' until the run has ended, and then exit_status
                             -- is that of the program
) WITHOUT ROWID;

CREATE TABLE agents (
  agent INTEGER PRIMARY KEY, -- address
  name TEXT NOT NULL,
  kind TEXT NOT NULL,        -- 'mote' or 'robot'
  program TEXT NOT NULL,     -- controller
  x REAL, y REAL, theta REAL -- pose at the start
);

CREATE TABLE ends (          -- end conditions of the scenario
  agent INTEGER,             -- null: at a time
  state TEXT,                -- the agent's controller enters this state ...
  after_ns INTEGER,          -- ... this long before the end
  result TEXT                -- what the run is then called
);

CREATE TABLE walls (         -- boxes that never move
  name TEXT,
  x REAL, y REAL, yaw REAL,  -- middle; its own x axis
  size_x REAL, size_y REAL   -- along its own axes
);

CREATE TABLE links (         -- pairs that can hear each other at the start, lower address first
  a INTEGER, b INTEGER
);

CREATE TABLE frames_sent (   -- class: 'broadcast' and 'unicast' (data), 'rts', 'cts', 'ack'
  agent INTEGER, peer INTEGER, class TEXT, count INTEGER,
  PRIMARY KEY (agent, peer, class)
) WITHOUT ROWID;

CREATE TABLE receptions (    -- how frames ended at the radios that could notice them
  agent INTEGER, peer INTEGER, -- receiver, transmitter
  class TEXT,
  addressed INTEGER,         -- 1: to this agent or to everyone
  verdict TEXT, count INTEGER,
  PRIMARY KEY (agent, peer, class, addressed, verdict)
) WITHOUT ROWID;

CREATE TABLE packets (       -- frames whose payload went up to the network layer
  agent INTEGER, peer INTEGER, -- receiver, transmitter
  class TEXT,                -- 'broadcast' or 'unicast'
  count INTEGER,
  PRIMARY KEY (agent, peer, class)
) WITHOUT ROWID;

CREATE TABLE requests (      -- how the link did with what it was asked to send
  agent INTEGER, peer INTEGER, -- sender, destination
  verdict TEXT, count INTEGER,
  PRIMARY KEY (agent, peer, verdict)
) WITHOUT ROWID;

CREATE TABLE messages (      -- what controllers sent
  sender INTEGER, id INTEGER,
  destination INTEGER, topic TEXT, bytes INTEGER,
  sent_ns INTEGER,
  fate TEXT, fate_ns INTEGER, -- as told to the sender; null: not yet
  verdict TEXT,              -- how it ended; 'delivered' wins over the end of another copy;
                             -- null: on its way at the end of the run
  PRIMARY KEY (sender, id)
) WITHOUT ROWID;

CREATE TABLE deliveries (    -- messages handed to a controller; a flood once per node
  sender INTEGER, id INTEGER, receiver INTEGER,
  at_ns INTEGER,
  delay_ns INTEGER,          -- since it was sent, waiting for a route included
  transmissions INTEGER,     -- on its way, the last hop included; null: unknown
  PRIMARY KEY (sender, id, receiver)
) WITHOUT ROWID;

CREATE TABLE discoveries (   -- searches for a route
  agent INTEGER, topic TEXT, destination INTEGER,
  ended_ns INTEGER, took_ns INTEGER,
  found INTEGER              -- 0: given up
);

CREATE TABLE poses (         -- once per period (1 s), and only if the agent moved since
  agent INTEGER, at_ns INTEGER, x REAL, y REAL, theta REAL,
  PRIMARY KEY (agent, at_ns)
) WITHOUT ROWID;

CREATE TABLE bodies (        -- of the whole run, seen at each control instant
  agent INTEGER PRIMARY KEY,
  path REAL,                 -- m travelled
  clearance REAL,            -- least distance of the centre to a wall's surface; null: no wall
  tilt REAL,                 -- greatest
  x REAL, y REAL, theta REAL, -- last pose
  wall_steps INTEGER,        -- physics steps in contact with a wall ...
  object_steps INTEGER       -- ... with another body; null until the run has ended
);

CREATE TABLE lost_bodies (   -- bodies that tipped over (tilt above 1 rad) or left the world
  agent INTEGER PRIMARY KEY,
  at_ns INTEGER, what TEXT
);

CREATE TABLE states (        -- named by controllers
  agent INTEGER, at_ns INTEGER, state TEXT
);

CREATE TABLE turns (         -- in real time: when a controller process had an influence
  at_ns INTEGER,             -- all events up to this time had run
  process INTEGER,           -- controller processes in order of their lowest agent, from 0
  replied INTEGER,           -- 1: its answer took effect ...
  began INTEGER              -- 1: ... and then it was given what waited
);

CREATE TABLE fingerprints (  -- hashes of what was observed; part: air, bodies, exchange, routing
  second INTEGER, part TEXT, agent INTEGER, hash TEXT,
  PRIMARY KEY (second, part, agent)
) WITHOUT ROWID;

CREATE TABLE frames (        -- only with record: {frames: all}
  frame INTEGER PRIMARY KEY, at_ns INTEGER, class TEXT,
  transmitter INTEGER, receiver INTEGER, sequence INTEGER, retry INTEGER,
  bits INTEGER, airtime_ns INTEGER
);

CREATE TABLE frame_ends (    -- likewise
  frame INTEGER, agent INTEGER, at_ns INTEGER, verdict TEXT, rssi_dbm REAL
);
)sql";

/// Makes the tables in a new file. It does not wait for the disk, then or later: if the machine
/// dies, the last seconds are lost, but not if the process does.
inline void create_tables(Database& database) {
  database.execute("PRAGMA synchronous = OFF; BEGIN");
  database.execute(kSchema);
  database.execute(fmt::format("PRAGMA user_version = {}; COMMIT", kSchemaVersion));
}

}  // namespace sim::record
