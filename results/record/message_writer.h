#pragma once

#include <vector>

#include "results/record/broadcast_watch.h"
#include "results/record/protocols.h"
#include "results/record/schema.h"
#include "results/record/topic_writer.h"

namespace results::record {

/// What both writers of messages need: it derives the ends that the network does not report, of
/// broadcasts that reach nobody and of messages that an access point could not relay.
class MessageWriter : public TopicWriter {
 public:
  /// @param protocols  outlives it.
  explicit MessageWriter(const Protocols& protocols);

  /// Views that are the same for listed and for counted messages.
  static std::vector<Table> end_views();
  static std::vector<Table> delivery_views();

  void on_frame_start(hal::Time at, const sim::radio::Frame& frame) override {
    broadcasts_.on_frame_start(at, frame);
  }
  void on_reception(hal::Time, const sim::radio::Frame& frame, hal::AgentId, hal::Verdict verdict,
                    double) override {
    broadcasts_.on_reception(frame, verdict);
  }
  void on_relay_lost(hal::Time at, hal::AgentId source, const sim::radio::MacRequest& request,
                     hal::Verdict verdict) override;
  void on_message_end(hal::Time at, hal::AgentId at_node, hal::AgentId sender, hal::MessageId id,
                      hal::Verdict verdict) override = 0;

  void finish(hal::Time ended_at) override { broadcasts_.finish(ended_at); }

 private:
  const Protocols& protocols_;
  BroadcastWatch broadcasts_;
};

}  // namespace results::record
