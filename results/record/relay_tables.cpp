#include "results/record/relay_tables.h"

namespace results::record {

std::vector<Table> relay_tables() {
  return {
      {"relays",
       "data frames of stations that came to an access point to be passed on, from the air or over "
       "the wire, those that it passed on and those that it could not, retries not counted; and "
       "frames that came to whom they are for and could not be used there",
       {{"agent", "INTEGER NOT NULL", "",
         "access point; of 'no route' also the destination itself: it acknowledged the frame and "
         "was with no access point"},
        {"source", "INTEGER NOT NULL", "", "agent that sent it first"},
        {"destination", "INTEGER NOT NULL", "", "agent that it is for, or everyone"},
        {"verdict", "TEXT NOT NULL", "",
         "'delivered': acknowledged by the destination; 'transmitted': to everyone of its BSS; "
         "'over the wire': to another access point, where it is counted again; 'queue full'; "
         "'retry limit'; 'no route': the source, or the destination, is associated nowhere; "
         "'expired'; 'radio off'; 'waiting': in the queue when this was written"},
        {"count", "INTEGER NOT NULL", "", "frames"}},
       "agent, source, destination, verdict"},
      {"relay_queues",
       "the queues of access points by destination, of what they pass on",
       {{"agent", "INTEGER NOT NULL", "", "access point"},
        {"destination", "INTEGER NOT NULL", "", "agent, or everyone"},
        {"frames", "INTEGER NOT NULL", "", "that found room in the queue"},
        {"waiting", "INTEGER NOT NULL", "", "of these, there when this was written"},
        {"most", "INTEGER NOT NULL", "", "that waited at once"},
        {"waited_ns", "INTEGER NOT NULL", "ns",
         "of all of them in sum: by the frames the mean time in the queue, by the length of the "
         "run the mean number"}},
       "agent, destination"},
  };
}

}  // namespace results::record
