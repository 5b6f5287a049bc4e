#pragma once

#include <cstdint>

#include "hal/types/agent_id.h"
#include "sim/core/event_queue.h"
#include "sim/radio/mac/carrier_sense.h"
#include "sim/radio/mac/exchange.h"
#include "sim/radio/mac/frame_factory.h"
#include "sim/radio/mac/originator.h"
#include "sim/radio/mac/ppdu.h"
#include "sim/radio/phy/radio.h"

namespace sim::radio {

/// How an exchange of the station ended.
enum class ExchangeEnd : std::uint8_t {
  kDelivered,  ///< An ACK came, or none was to come.
  kBlockAck,
  kNoCts,     ///< No CTS came: the data were not sent.
  kNoAnswer,  ///< No ACK or BlockAck came.
};

class FrameSequenceListener {
 public:
  virtual ~FrameSequenceListener() = default;
  /// @param answer  the BlockAck if there is one.
  virtual void on_exchange_end(ExchangeEnd end, const BlockAckFields* answer) = 0;
};

/// The sequence of frames of one station (IEEE Std 802.11-2020, 10.3.2 and annex G): its own
/// exchanges, and answers to others.
///
///              start(): RTS              CTS received: SIFS, data
///   kIdle ---------------------> kWaitCts --------------------> kWaitAnswer
///     ^ |                          |                              ^  |
///     | +-- start(): data ---------|------------------------------+  |
///     | +-- start(): group --------|--> kGroup                       |
///     | +-- start(): CTS-to-self, SIFS, then data or group           |
///     +--- on_exchange_end(): frame sent, answer, or timeout --------+
///
/// RTS and data of others are answered after SIFS in any state.
class FrameSequence {
 public:
  struct Parts {
    EventQueue& events;
    Radio& radio;
    CarrierSense& carrier;
    const ModeSet& modes;
  };
  /// @param parts,frames,originator,listener  outlive this object.
  FrameSequence(const Parts& parts, FrameFactory& frames, Originator& originator,
                FrameSequenceListener& listener);

  bool is_idle() const { return state_ == State::kIdle; }
  /// The exchange that is going on, or was the last.
  const Exchange& exchange() const { return exchange_; }
  /// Whether the next frame received decides on the exchange.
  bool is_awaiting() const { return awaiting_; }
  /// Whether it is the answer to what was sent.
  bool is_answer(const Frame& frame) const;

  /// Starts an exchange now; the medium is the station's. @pre idle.
  void start(const Exchange& exchange);
  /// Starts one after SIFS, in the same TXOP. @pre idle.
  void start_after_sifs(const Exchange& exchange);
  /// Sends an answer to another station after SIFS.
  void answer(FramePtr frame);

  void on_answer(const Frame& frame);
  /// A frame was received that is not the awaited answer, or an erroneous one.
  void on_wrong_answer();
  void on_transmit_end(const Ppdu& ppdu);
  /// When the radio is switched.
  void reset();

 private:
  enum class State : std::uint8_t { kIdle, kTxop, kReserving, kGroup, kWaitCts, kWaitAnswer };

  void open();
  void send(const PpduPtr& ppdu);
  void send_after_sifs(PpduPtr ppdu);
  void on_timeout();
  void fail(bool is_receiving);
  void end(ExchangeEnd how, const BlockAckFields* answer);
  PpduPtr make_data();
  FramePtr make_rts();
  FramePtr make_cts_to_self();
  hal::Duration after_data() const;
  hal::Duration data_and_after() const;
  const DcfTiming& timing() const { return carrier_.timing(); }

  EventQueue& events_;
  Radio& radio_;
  CarrierSense& carrier_;
  const ModeSet& modes_;
  FrameFactory& frames_;
  Originator& originator_;
  FrameSequenceListener& listener_;

  State state_ = State::kIdle;
  Exchange exchange_{};
  bool awaiting_ = false;  ///< RTS or data have been sent.
  PpduPtr next_;           ///< To be sent after SIFS.
  EventQueue::EventId sifs_;
  EventQueue::EventId timeout_;
};

}  // namespace sim::radio
