#pragma once

#include <cstdint>

#include "sim/agents/observer.h"
#include "sim/core/fingerprint.h"

namespace sim::agents {

/// Digest of all frames of a run in the order in which their transmissions began: times, addresses,
/// rate, lengths and the other fields of the frame, and the bytes of its payload. Runs whose
/// stations sent the same bytes at the same times have equal digests, whatever else was different:
/// receptions, bodies and controllers are part of the fingerprint only. Its cost is that of hashing
/// the payloads; its size does not grow.
class FrameDigest final : public Observer {
 public:
  void on_frame_start(hal::Time at, const radio::Frame& frame) override;
  void on_frame_cut(hal::Time at, const radio::Frame& frame) override;

  /// Of the frames so far, 64 bits.
  std::uint64_t value() const { return hash_.value(); }

 private:
  Hash hash_;
};

}  // namespace sim::agents
