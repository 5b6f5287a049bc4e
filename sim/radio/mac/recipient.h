#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"
#include "sim/core/event_queue.h"
#include "sim/radio/mac/block_ack_action.h"
#include "sim/radio/mac/duplicate_filter.h"
#include "sim/radio/mac/frame_factory.h"
#include "sim/radio/mac/ppdu.h"
#include "sim/radio/mac/recipient_agreement.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// Gets what a station has received, without duplicates and in order.
class RecipientListener {
 public:
  virtual ~RecipientListener() = default;
  virtual void on_mpdu(const Frame& frame, hal::Dbm rssi, hal::Decibels snr) = 0;
  /// An action frame of the recipient is to be sent.
  /// @param about  a frame of the receiver: the action belongs to the same BSS.
  virtual void send_action(const Frame& about, const BlockAckAction& action) = 0;
};

/// The recipient of data and of Block Ack: makes the answers to what a station receives, and
/// removes duplicates and restores the order (IEEE Std 802.11-2020, 10.3.2.11, 10.3.2.14
/// and 10.25).
class Recipient {
 public:
  /// @param config,frames,listener  outlive this object.
  Recipient(EventQueue& events, hal::AgentId agent, const DcfConfig& config, FrameFactory& frames,
            RecipientListener& listener);
  ~Recipient();
  Recipient(const Recipient&) = delete;
  Recipient& operator=(const Recipient&) = delete;

  /// The answer to data or management for this station; null: none.
  FramePtr answer_to(const ReceivedPpdu& received);
  /// Passes on the MPDUs that this station has received.
  void accept(const ReceivedPpdu& received);
  /// Answers a BlockAckReq; null: there is no agreement.
  FramePtr answer_to_request(const Frame& request);
  /// @param frame  that carries the request.
  void on_request(const Frame& frame, const AddBlockAckRequest& request);
  void on_delete(hal::AgentId from, const DeleteBlockAck& del);
  /// Forgets all agreements: the radio is switched off.
  void reset();

 private:
  struct Agreement {
    RecipientAgreement state;
    EventQueue::EventId gap{};  ///< When it stops waiting for a missing MPDU.
  };
  using Key = std::pair<hal::AgentId, std::uint8_t>;

  Agreement* agreement_for(const Frame& frame);
  void accept(const ReceivedMpdu& mpdu);
  void pass_on(const std::vector<ReceivedMpdu>& released);
  void watch_gap(Agreement& agreement);

  EventQueue& events_;
  hal::AgentId agent_;
  const DcfConfig& config_;
  FrameFactory& frames_;
  RecipientListener& listener_;
  DuplicateFilter duplicates_;
  std::map<Key, Agreement> agreements_;
};

}  // namespace sim::radio
