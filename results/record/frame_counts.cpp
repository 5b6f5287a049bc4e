#include "results/record/frame_counts.h"

#include <array>

#include "sim/radio/mac/frame_class.h"

namespace results::record {
namespace {

/// The kind of a reception as one number: verdict (4 bits), addressed (1 bit), frame class.
constexpr int kAddressedBit = 4;
constexpr int kClassShift = 5;
/// Stands in place of a verdict that no reception has: the payload was delivered to the upper
/// layer.
constexpr std::uint8_t kWentUp = (1 << kAddressedBit) - 1;
static_assert(kWentUp == static_cast<std::uint8_t>(hal::Verdict::kQueueDelay));
static_assert(hal::kVerdictCount <= 1 << kAddressedBit);
static_assert(sim::radio::kFrameClasses << kClassShift <= 1 << PairCounts::kKindBits);

std::uint8_t kind_of(const sim::radio::Frame& frame) {
  return static_cast<std::uint8_t>(sim::radio::frame_class(frame));
}

std::string_view class_in(std::uint8_t kind) {
  return sim::radio::name(static_cast<sim::radio::FrameClass>(kind));
}

std::string_view verdict_in(std::uint8_t kind) {
  return hal::name(static_cast<hal::Verdict>(kind % (1 << kAddressedBit)));
}

/// Longest time after its end at the transmitter at which a frame can end at a receiver: the
/// propagation delay across any field (300 km).
hal::Duration tail_of(const sim::radio::RadioConfig& config) {
  const sim::radio::WavesConfig* const waves = sim::radio::waves_of(config);
  const bool is_delayed = waves != nullptr && waves->propagation.propagation_delay;
  return is_delayed ? std::chrono::milliseconds{1} : hal::Duration{};
}

/// Meaning of the verdict in both views of what became of all frames sent.
constexpr std::string_view kDerived =
    "outcome as in receptions; 'below sensitivity' also if the radio did not sense it, e.g. on "
    "another channel, or only as interference (faint), so that every frame sent has an outcome; "
    "'under way': it was still being transmitted at the end or, with propagation delay, had ended "
    "less than 1 ms before";

}  // namespace

FrameCounts::FrameCounts(Database& database, const sim::radio::RadioConfig& radio, Commits& commits)
    : put_sent_(database, "REPLACE INTO frames_sent VALUES (?, ?, ?, ?)"),
      put_reception_(database, "REPLACE INTO receptions VALUES (?, ?, ?, ?, ?, ?)"),
      put_faint_(database, "REPLACE INTO faint VALUES (?, ?)"),
      put_packet_(database, "REPLACE INTO packets VALUES (?, ?, ?, ?)"),
      put_request_(database, "REPLACE INTO requests VALUES (?, ?, ?, ?)"),
      in_the_air_(database, tail_of(radio)),
      commits_(commits) {}

void FrameCounts::on_frame_start(hal::Time at, const sim::radio::Frame& frame) {
  sent_.add(frame.transmitter, frame.receiver, kind_of(frame));
  in_the_air_.on_frame_start(at, frame);
}

void FrameCounts::on_reception(hal::Time at, const sim::radio::Frame& frame, hal::AgentId receiver,
                               hal::Verdict verdict, double) {
  commits_.see(at);
  if (frame.transmitter != heard_) {
    heard_ = frame.transmitter;
    receptions_.prefetch(heard_);
  }
  in_the_air_.on_reception(frame, receiver);
  const bool addressed = frame.is_broadcast() || frame.receiver == receiver;
  const int kind = (kind_of(frame) << kClassShift) | (addressed ? 1 << kAddressedBit : 0) |
                   static_cast<int>(verdict);
  receptions_.add(frame.transmitter, receiver, static_cast<std::uint8_t>(kind));
}

void FrameCounts::on_faint(const sim::radio::Frame& frame, std::uint32_t radios) {
  const std::size_t transmitter = frame.transmitter.value;
  if (transmitter >= faint_.size()) faint_.resize(transmitter + 1);
  faint_[transmitter] += radios;
}

void FrameCounts::on_delivered(hal::Time, const sim::radio::Frame& frame, hal::AgentId receiver) {
  const int kind = (kind_of(frame) << kClassShift) | kWentUp;
  receptions_.add(frame.transmitter, receiver, static_cast<std::uint8_t>(kind));
}

void FrameCounts::on_request_end(hal::Time, hal::AgentId sender, hal::AgentId destination,
                                 hal::Verdict verdict) {
  requests_.add(sender, destination, static_cast<std::uint8_t>(verdict));
}

TopicWriter::Pending FrameCounts::pending() const {
  return {.rows = sent_.changed() + receptions_.changed() + requests_.changed(),
          .counted = sent_.added() + receptions_.added() + requests_.added()};
}

void FrameCounts::write(hal::Time now) {
  sent_.write_changes([this](auto sender, auto receiver, std::uint8_t kind, std::uint64_t count) {
    put_sent_.run(sender.value, receiver.value, class_in(kind), count);
  });
  receptions_.write_changes_by_second(
      [this](auto sender, auto receiver, std::uint8_t kind, std::uint64_t count) {
        const auto frame_class = class_in(static_cast<std::uint8_t>(kind >> kClassShift));
        if ((kind & kWentUp) == kWentUp) {
          put_packet_.run(receiver.value, sender.value, frame_class, count);
          return;
        }
        const bool addressed = (kind & (1 << kAddressedBit)) != 0;
        put_reception_.run(receiver.value, sender.value, frame_class, addressed, verdict_in(kind),
                           count);
      });
  for (std::size_t agent = 0; agent < faint_.size(); ++agent) {
    if (faint_[agent] > 0) put_faint_.run(agent, faint_[agent]);
  }
  requests_.write_changes(
      [this](auto sender, auto destination, std::uint8_t kind, std::uint64_t count) {
        const bool unknown = destination == hal::kEveryone &&
                             static_cast<hal::Verdict>(kind) == hal::Verdict::kDelivered;
        put_request_.run(sender.value, destination.value,
                         unknown ? "transmitted" : verdict_in(kind), count);
      });
  in_the_air_.write(now);
}

std::vector<Table> FrameCounts::sent_tables() {
  return {
      {"frames_sent",
       "number of frames sent; each MPDU of an A-MPDU is one",
       {{"agent", "INTEGER NOT NULL", "", "transmitter"},
        {"peer", "INTEGER NOT NULL", "", "receiver"},
        {"class", "TEXT NOT NULL", "",
         "'broadcast' or 'unicast' (data), 'rts', 'cts', 'ack', 'beacon', 'management' (the other "
         "management frames), 'block_ack' (BlockAck and BlockAckReq)"},
        {"count", "INTEGER NOT NULL", "", "frames"}},
       "agent, peer, class"},
      {"receptions",
       "outcome of frames at the radios where each frame alone was strong enough to be received or "
       "sensed",
       {{"agent", "INTEGER NOT NULL", "", "receiver"},
        {"peer", "INTEGER NOT NULL", "", "transmitter"},
        {"class", "TEXT NOT NULL", "", "as in frames_sent"},
        {"addressed", "INTEGER NOT NULL", "", "1: to this agent or to everyone"},
        {"verdict", "TEXT NOT NULL", "", "outcome"},
        {"count", "INTEGER NOT NULL", "", "receptions"}},
       "agent, peer, class, addressed, verdict"},
  };
}

std::vector<Table> FrameCounts::end_tables() {
  return {
      {"faint",
       "interference: frames too weak for a radio to receive or sense; no other table mentions "
       "them",
       {{"agent", "INTEGER PRIMARY KEY", "", "transmitter"},
        {"count", "INTEGER NOT NULL", "",
         "number of radios where a frame was above the interference floor only, summed over the "
         "frames of this transmitter"}}},
      {"packets",
       "frames, and MSDUs of A-MSDUs, whose payload was passed to the network layer",
       {{"agent", "INTEGER NOT NULL", "", "receiver"},
        {"peer", "INTEGER NOT NULL", "", "transmitter"},
        {"class", "TEXT NOT NULL", "", "'broadcast' or 'unicast'"},
        {"count", "INTEGER NOT NULL", "", "packets"}},
       "agent, peer, class"},
      {"requests",
       "outcome of what the link layer was asked to send; at an access point also of what it "
       "relayed, see relays",
       {{"agent", "INTEGER NOT NULL", "", "sender"},
        {"peer", "INTEGER NOT NULL", "", "destination"},
        {"verdict", "TEXT NOT NULL", "",
         "outcome; 'transmitted': a broadcast that was sent; who received it is in the table "
         "receptions"},
        {"count", "INTEGER NOT NULL", "", "requests"}},
       "agent, peer, verdict"},
  };
}

std::vector<Table> FrameCounts::link_views() {
  return {
      {"link_verdicts",
       "outcome of every frame at every radio, for pairs of agents of which one sensed a frame of "
       "the other at any time; the counts add up to what the transmitter sent",
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
       " 'under way', a.frames FROM pairs p JOIN in_the_air a ON a.agent = p.peer"
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

std::vector<Table> FrameCounts::sum_views() {
  return {
      {"verdict_sums",
       "outcome of all frames at all other radios; the counts add up to frames sent times radios",
       {{"class", "TEXT", "", "as in frames_sent"},
        {"addressed", "INTEGER", "", "1: to this radio or to everyone"},
        {"verdict", "TEXT", "", kDerived},
        {"count", "INTEGER", "", "pairs of a frame and a radio"}},
       "class, addressed, verdict",
       "WITH others AS (SELECT COUNT(*) - 1 AS radios FROM agents),"
       // A CTS-to-self is addressed to no other radio.
       " possible AS (SELECT class, 1 AS addressed,"
       " SUM(count * CASE WHEN peer >= 65534 THEN radios ELSE peer <> agent END) AS count"
       " FROM frames_sent, others GROUP BY 1"
       " UNION ALL SELECT class, 0, SUM(count * (radios - (peer <> agent)))"
       " FROM frames_sent, others WHERE peer < 65534 GROUP BY 1),"
       " in_air AS (SELECT class, 1 AS addressed,"
       " SUM(frames * CASE WHEN peer >= 65534 THEN radios ELSE peer <> agent END) AS count"
       " FROM in_the_air, others GROUP BY 1"
       " UNION ALL SELECT class, 0, SUM(frames * (radios - (peer <> agent))) FROM in_the_air, "
       "others"
       " WHERE peer < 65534 GROUP BY 1"
       " UNION ALL SELECT a.class, a.peer IN (e.agent, 65534, 65535), -SUM(a.frames)"
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

}  // namespace results::record
