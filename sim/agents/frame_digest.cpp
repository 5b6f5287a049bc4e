#include "sim/agents/frame_digest.h"

#include "sim/agents/ppdu_content.h"
#include "sim/radio/mac/frame.h"

namespace sim::agents {
namespace {

/// What an entry of the digest is about.
enum class Entry : std::uint8_t { kStart, kCut };

void begin(Hash& hash, Entry entry, hal::Time at, const radio::Frame& frame) {
  hash.add(static_cast<std::uint64_t>(entry));
  hash.add(hal::to_ns(at));
  hash.add(std::uint64_t{frame.transmitter.value});
}

}  // namespace

void FrameDigest::on_frame_start(hal::Time at, const radio::Frame& frame) {
  begin(hash_, Entry::kStart, at, frame);
  hash_.add(std::uint64_t{frame.receiver.value});
  hash_.add(static_cast<std::uint64_t>(frame.type));
  hash_.add(static_cast<std::uint64_t>(frame.ds));
  hash_.add(std::uint64_t{frame.address3.value});
  hash_.add(frame.group);
  hash_.add(std::uint64_t{frame.sequence});
  hash_.add(std::uint64_t{frame.retry});
  hash_.add(frame.rate.value);
  hash_.add(std::uint64_t{frame.air_length});
  hash_.add(std::int64_t{frame.airtime.count()});
  hash_.add(std::int64_t{frame.duration.count()});
  hash_.add(std::uint64_t{frame.ethertype});
  add_payload(hash_, frame);
  add_ppdu(hash_, frame);
}

void FrameDigest::on_frame_cut(hal::Time at, const radio::Frame& frame) {
  begin(hash_, Entry::kCut, at, frame);
}

}  // namespace sim::agents
