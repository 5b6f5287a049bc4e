#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "results/record/commits.h"
#include "results/record/database.h"
#include "results/record/message_writer.h"

namespace results::record {

/// Writes the tables messages and deliveries.
class MessageLog final : public MessageWriter {
 public:
  MessageLog(Database& database, const Protocols& protocols, Commits& commits);

  static std::vector<Table> tables();

  void on_message_sent(hal::Time at, const hal::Message& message) override;
  void on_message_delivered(hal::Time at, hal::AgentId receiver, const hal::Message& message,
                            int transmissions) override;
  void on_fate(hal::Time at, hal::AgentId sender, hal::MessageId id, hal::Fate fate) override;
  void on_message_end(hal::Time at, hal::AgentId at_node, hal::AgentId sender, hal::MessageId id,
                      hal::Verdict verdict) override;

 private:
  /// One of the last messages of a sender; spares looking for its row.
  struct Sent {
    std::optional<hal::MessageId> id;
    hal::Time sent{};
    bool is_delivered = false;  ///< Its row says so.
  };
  static constexpr std::size_t kLatest = 16;
  /// Null: an older one, or not listed.
  Sent* find(hal::AgentId sender, hal::MessageId id);

  std::vector<std::vector<Sent>> latest_;  ///< By sender, then by the remainder of the number.
  Statement insert_, insert_delivery_, find_delivery_, set_fate_, set_delivered_, set_verdict_;
  Commits& commits_;
};

}  // namespace results::record
