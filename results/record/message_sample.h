#pragma once

#include <cstdint>
#include <vector>

#include "results/record/message_counts.h"
#include "results/record/message_log.h"
#include "results/record/message_writer.h"

namespace results::record {

/// Lists messages to one agent, and of those to everyone and to neighbours the first ones of each
/// simulated second, until they and their deliveries are kRowsOfSecond rows; the others are
/// counted. Whether a message is listed is decided when it is sent, for its deliveries, too.
class MessageSample final : public MessageWriter {
 public:
  static constexpr std::uint64_t kRowsOfSecond = 1000;

  MessageSample(Database& database, const Protocols& protocols, Commits& commits);

  void on_message_sent(hal::Time at, const hal::Message& message) override;
  void on_message_delivered(hal::Time at, hal::AgentId receiver, const hal::Message& message,
                            int transmissions) override;
  void on_fate(hal::Time at, hal::AgentId sender, hal::MessageId id, hal::Fate fate) override;
  void on_message_end(hal::Time at, hal::AgentId at_node, hal::AgentId sender, hal::MessageId id,
                      hal::Verdict verdict) override;

  void write(hal::Time now) override { counts_.write(now); }
  Pending pending() const override { return counts_.pending(); }

 private:
  /// Numbers of a sender's messages at which counting begins, ends, begins, ..., ascending.
  using Switches = std::vector<hal::MessageId>;

  static bool is_counted(const Switches& switches, hal::MessageId id);
  Switches& switches_of(hal::AgentId sender);
  /// @return whether there is room for a row in the second of `at`.
  bool has_room(hal::Time at);
  void note_row(hal::Time at, const hal::Message& message, const MessageWriter& writer);
  MessageWriter& writer_of(hal::AgentId sender, hal::MessageId id);

  MessageLog log_;
  MessageCounts counts_;
  std::vector<Switches> switches_;  ///< By sender.
  std::int64_t second_ = -1;
  std::uint64_t rows_ = 0;  ///< In second_.
};

}  // namespace results::record
