#pragma once

#include <cstdint>

#include "sim/radio/mac/frame.h"

namespace sim::agents {

/// Adds the bytes of a frame's payload, or of each MSDU of its A-MSDU with what tells it apart.
/// @param hash  a Hash or a Fingerprint::Cell.
template <class Sink>
void add_payload(Sink& hash, const radio::Frame& frame) {
  if (!frame.amsdu) {
    if (frame.payload) hash.add_bytes(frame.payload->data(), frame.payload->size());
    return;
  }
  hash.add(std::uint64_t{frame.amsdu->size()});
  for (const radio::AmsduPart& part : *frame.amsdu) {
    hash.add(std::uint64_t{part.source.value});
    hash.add(std::uint64_t{part.destination.value});
    hash.add(std::uint64_t{part.ethertype});
    hash.add_bytes(part.payload->data(), part.payload->size());
  }
}

/// Adds what only frames with QoS, A-MPDUs, Block Ack and modes with an MCS have: each of these
/// only if it is present, so that frames without it keep their hash.
template <class Sink>
void add_ppdu(Sink& hash, const radio::Frame& frame) {
  if (frame.qos) hash.add(std::uint64_t{frame.priority});
  if (frame.ampdu != 0) {
    hash.add(std::uint64_t{frame.ampdu});
    hash.add(std::uint64_t{frame.is_last_of_ampdu});
  }
  if (frame.block_ack) {
    const radio::BlockAckFields& fields = *frame.block_ack;
    hash.add(std::uint64_t{fields.tid});
    hash.add(std::uint64_t{fields.start});
    hash.add(std::uint64_t{fields.length});
    for (std::uint32_t bit = 0; bit < fields.length; ++bit)
      hash.add(std::uint64_t{fields.received[bit]});
  }
  if (frame.mode == nullptr || !radio::has_streams(frame.mode->modulation_class())) return;
  const radio::ModeId& mode = frame.mode->id();
  hash.add(static_cast<std::uint64_t>(mode.modulation));
  hash.add(std::uint64_t{mode.mcs});
  hash.add(std::uint64_t{mode.streams});
  hash.add(std::uint64_t{mode.width});
  hash.add(std::int64_t{mode.guard.count()});
}

}  // namespace sim::agents
