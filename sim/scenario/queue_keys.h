#pragma once

#include <array>

#include "sim/radio/radio_config.h"
#include "sim/scenario/fields.h"

/// The keys of the queues of a DCF.
namespace sim::scenario {

inline constexpr std::array kQueuesPer = {
    Option<radio::QueuePer>{"radio", radio::QueuePer::kRadio},
    Option<radio::QueuePer>{"station", radio::QueuePer::kStation}};
inline constexpr std::array kDisciplines = {
    Option<radio::Discipline>{"fifo", radio::Discipline::kFifo},
    Option<radio::Discipline>{"fq_codel", radio::Discipline::kFqCodel}};

inline void keys_of(Fields& io, radio::FqCodelConfig& c) {
  io.duration({"target", "Time in a queue above which frames have waited too long.", "20 ms"},
              {1e-6, 10}, c.target);
  io.duration({"interval",
               "How long that may last before frames are dropped; then one after each interval "
               "divided by the root of the number of drops. Longer than `target`.",
               "300 ms"},
              {1e-6, 100}, c.interval);
  io.count({"quantum", "Bytes that a flow sends in its turn.", "1514"}, 1, 1'000'000, c.quantum);
  io.count(
      {"flows", "Number of queues among which the flows of a receiver are dealt out by a hash.",
       "4096"},
      1, 65'536, c.flows);
}

inline void station_queue_keys(Fields& io, radio::QueuesConfig& c) {
  io.choice(
      {"discipline",
       "fifo: first in, first out; fq_codel: flows take turns, and CoDel drops frames of those "
       "that wait too long (`queue delay`).",
       "fq_codel"},
      kDisciplines, c.discipline);
  io.given_count(
      {"limit",
       "Frames that may wait in each queue. Further ones are dropped, with `fq_codel` the "
       "oldest of the flow with most bytes.",
       "10240", "that of `queue_limit`"},
      1, 10'000'000, c.limit);
  io.given_count({"limit_bytes", "The same in bytes of payload.", "100000", "none"}, 1,
                 1'000'000'000, c.limit_bytes);
  io.only(c.discipline == radio::Discipline::kFqCodel, {"discipline", {"fq_codel"}},
          "needs `discipline: fq_codel`", [&](Fields& codel) { keys_of(codel, c.fq_codel); });
  io.flag({"airtime_fairness",
           "Whether the receivers of a category share airtime, of frames to and from them, rather "
           "than turns.",
           "true"},
          c.airtime_fairness);
  io.duration({"airtime_quantum", "With `airtime_fairness`: airtime of a receiver's turn.", "1 ms"},
              {1e-6, 1}, c.airtime_quantum);
}

inline void keys_of(Fields& io, radio::QueuesConfig& c) {
  io.choice({"per",
             "What has a queue. radio: each agent one, first in, first out, with `queue_limit`; "
             "station: each receiver in each access category, in the MAC that sends, from which "
             "frames go when they are about to be sent.",
             "station"},
            kQueuesPer, c.per);
  io.only(c.per == radio::QueuePer::kStation, {"per", {"station"}}, "needs `per: station`",
          [&](Fields& station) { station_queue_keys(station, c); });
}

}  // namespace sim::scenario
