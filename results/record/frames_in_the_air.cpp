#include "results/record/frames_in_the_air.h"

namespace results::record {

FramesInTheAir::FramesInTheAir(Database& database, hal::Duration tail)
    : clear_(database, "DELETE FROM in_the_air"),
      clear_ended_(database, "DELETE FROM in_the_air_ended"),
      insert_(database, "INSERT INTO in_the_air VALUES (?, ?, ?, ?)"),
      insert_ended_(database, "INSERT INTO in_the_air_ended VALUES (?, ?)"),
      tail_(tail) {}

void FramesInTheAir::on_frame_start(hal::Time at, const sim::radio::Frame& frame) {
  if (frame.transmitter.value >= last_.size()) last_.resize(frame.transmitter.value + 1u);
  Last& last = last_[frame.transmitter.value];
  if (frame.ampdu != 0 && frame.ampdu == last.ampdu) {
    ++last.frames;
    return;
  }
  last.frame = frame.id;
  last.ampdu = frame.ampdu;
  last.frames = 1;
  last.receiver = frame.receiver;
  last.kind = sim::radio::frame_class(frame);
  last.end = at + frame.ppdu_airtime();
  last.ended_at.clear();
}

void FramesInTheAir::on_frame_cut(hal::Time at, const sim::radio::Frame& frame) {
  if (frame.transmitter.value >= last_.size()) return;
  Last& last = last_[frame.transmitter.value];
  if (last.frame == frame.id) last.end = at;
}

void FramesInTheAir::write(hal::Time now) {
  clear_.run();
  clear_ended_.run();
  for (std::size_t agent = 0; agent < last_.size(); ++agent) {
    const Last& last = last_[agent];
    if (last.frame == 0 || last.end + tail_ < now) continue;
    insert_.run(agent, last.receiver.value, sim::radio::name(last.kind),
                std::uint64_t{last.frames});
    for (const hal::AgentId receiver : last.ended_at) insert_ended_.run(receiver.value, agent);
  }
}

std::vector<Table> FramesInTheAir::tables() {
  return {
      {"in_the_air",
       "frames still being transmitted when the totals were last written, which is at the end of "
       "the run unless it was killed",
       {{"agent", "INTEGER PRIMARY KEY", "", "transmitter"},
        {"peer", "INTEGER NOT NULL", "", "receiver"},
        {"class", "TEXT NOT NULL", "", "as in frames_sent"},
        {"frames", "INTEGER NOT NULL", "", "1, or MPDUs of the A-MPDU"}}},
      {"in_the_air_ended",
       "radios at which such frames had ended already: receptions includes them",
       {{"agent", "INTEGER NOT NULL", "", "receiver"},
        {"peer", "INTEGER NOT NULL", "", "transmitter"}},
       "agent, peer"},
  };
}

}  // namespace results::record
