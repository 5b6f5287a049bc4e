#pragma once

#include <boost/container/small_vector.hpp>
#include <cstdint>

#include "hal/types/agent_id.h"
#include "hal/types/verdict.h"
#include "sim/radio/mac/channel_access.h"
#include "sim/radio/mac/mac_sap.h"
#include "sim/radio/mac/protection.h"
#include "sim/radio/phy/phy_mode.h"

namespace sim::radio {

struct MpduStream;  // mpdu_stream.h

/// A frame exchange that a station is about to have: what it sends, how it reserves the medium, and
/// what answers.
struct Exchange {
  enum class Kind : std::uint8_t {
    kHead,             ///< The head of the queue.
    kAggregate,        ///< The first MPDUs of a stream with a Block Ack agreement.
    kBlockAckRequest,  ///< Asks what has arrived of such a stream.
  };
  Kind kind = Kind::kHead;
  ContentionFunction function = 0;
  hal::AgentId to{};              ///< kEveryone: nothing answers.
  const PhyMode* mode = nullptr;  ///< Mode of the data frame.
  Opening opening = Opening::kNone;
  std::uint32_t bits = 0;        ///< Length of its PSDU.
  MpduStream* stream = nullptr;  ///< Unless kHead.
  std::uint32_t mpdus = 1;       ///< kAggregate: number of MPDUs.

  bool is_group() const { return to == hal::kEveryone; }
  /// Whether a BlockAck answers, rather than an ACK.
  bool has_block_ack() const {
    return kind == Kind::kBlockAckRequest || (kind == Kind::kAggregate && mpdus > 1);
  }
};

/// A request that has ended.
struct EndedMsdu {
  MacRequest request;
  hal::Verdict verdict;
};
using EndedMsdus = boost::container::small_vector<EndedMsdu, 1>;

}  // namespace sim::radio
