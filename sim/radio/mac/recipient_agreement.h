#pragma once

#include <bitset>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "hal/types/quantity.h"
#include "hal/types/time.h"
#include "sim/radio/mac/block_ack_fields.h"
#include "sim/radio/mac/frame.h"
#include "sim/radio/mac/sequence_number.h"

namespace sim::radio {

/// A received MPDU on its way to the station's clients.
struct ReceivedMpdu {
  FramePtr frame;
  hal::Dbm rssi;
  hal::Decibels snr;
  hal::Time at{};
};

/// A Block Ack agreement at its recipient, for one originator and one TID: which MPDUs have been
/// received, and the buffer in which those wait that follow a missing one (IEEE Std 802.11-2020,
/// 10.25.6).
class RecipientAgreement {
 public:
  /// @param start  first sequence number. @param window  buffer size, 1 .. 256.
  RecipientAgreement(std::uint16_t start, std::uint32_t window)
      : window_(window), scored_from_(start), next_(start) {}

  /// Notes a received MPDU in the scoreboard (10.25.6.3).
  void score(std::uint16_t sequence);
  /// What a BlockAck sent now says.
  BlockAckFields block_ack(std::uint8_t tid) const;

  /// Buffers an MPDU unless it has been received before. @return those that are now in order.
  std::vector<ReceivedMpdu> accept(const ReceivedMpdu& mpdu);
  /// The originator has given up everything before `start` (BlockAckReq). @return what is released.
  std::vector<ReceivedMpdu> move_to(std::uint16_t start);
  /// Gives up waiting for what precedes the first buffered MPDU. @return what is released.
  std::vector<ReceivedMpdu> skip_gap();
  /// When the first buffered MPDU was received; nullopt: none is buffered.
  std::optional<hal::Time> waiting_since() const;

 private:
  void advance(std::uint32_t count, std::vector<ReceivedMpdu>& released);
  void release(std::vector<ReceivedMpdu>& released);

  std::uint32_t window_;
  std::uint16_t scored_from_;
  std::bitset<kLongestBitmap> scored_;
  std::uint16_t next_;                              ///< First MPDU that has not been passed on.
  std::deque<std::optional<ReceivedMpdu>> buffer_;  ///< From next_ on.
};

}  // namespace sim::radio
