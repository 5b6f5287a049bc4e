#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "results/record/database.h"
#include "results/record/delivery_totals.h"
#include "results/record/message_writer.h"

namespace results::record {

/// Writes the tables counted_ends, counted_fates and counted_deliveries, of messages that are not
/// listed.
///
/// Of each message its class, its time and its outcome so far are kept (16 bytes) until its verdict
/// and its fate are known and kKept of simulated time have passed; somewhat longer in fact, because
/// old messages are removed only from time to time. A later delivery is counted, but without a
/// delay, and does not change the verdict.
class MessageCounts final : public MessageWriter {
 public:
  static constexpr hal::Duration kKept = std::chrono::seconds{10};

  MessageCounts(Database& database, const Protocols& protocols);

  static std::vector<Table> tables();

  void on_message_sent(hal::Time at, const hal::Message& message) override;
  void on_message_delivered(hal::Time at, hal::AgentId receiver, const hal::Message& message,
                            int transmissions) override;
  void on_fate(hal::Time at, hal::AgentId sender, hal::MessageId id, hal::Fate fate) override;
  void on_message_end(hal::Time at, hal::AgentId at_node, hal::AgentId sender, hal::MessageId id,
                      hal::Verdict verdict) override;

  void write(hal::Time now) override;
  Pending pending() const override { return {.rows = changed_, .counted = counted_}; }

 private:
  static constexpr std::uint8_t kNothingYet = 0xff;

  struct Sent {
    hal::Time at{};
    std::uint32_t kind = 0;   ///< Index in Sender::kinds.
    std::uint16_t bytes = 0;  ///< Size of the payload.
    std::uint8_t verdict = kNothingYet;
    std::uint8_t fate = kNothingYet;

    bool is_settled() const { return verdict != kNothingYet && fate != kNothingYet; }
  };
  /// Messages with one verdict or fate.
  struct Count {
    std::uint64_t messages = 0;
    std::uint64_t bytes = 0;
    std::uint8_t key = 0;
    bool changed = false;
  };
  using Counts = std::vector<Count>;  ///< Few; in order of first occurrence.
  /// Messages of one sender that have the same destination and topic.
  struct Kind {
    std::uint32_t topic = 0;
    hal::AgentId destination{};
    Counts ends{}, fates{};
    bool changed = false;
  };
  struct Sender {
    std::vector<Kind> kinds;
    std::map<std::pair<std::uint32_t, std::uint16_t>, std::uint32_t> places;  ///< Index in kinds.
    std::uint32_t last_kind = 0;
    std::deque<Sent> sent;                     ///< Consecutive numbers, from `first`.
    hal::MessageId first = 1;                  ///< Number of sent.front().
    std::map<hal::MessageId, Sent> unsettled;  ///< Older than sent.front().
    DeliveryTotals deliveries;
  };

  Sender& sender(hal::AgentId agent);
  static Sent* find(Sender& sender, hal::MessageId id);
  std::uint32_t kind_of(Sender& sender, const hal::Message& message);
  static Count& count_of(Counts& counts, std::uint8_t key);
  void count(Kind& kind, Counts& counts, std::uint8_t key, const Sent& sent);
  static void forget(Sender& sender, hal::Time now);
  void write(std::uint16_t address, Sender& sender);
  void write_kind(std::uint16_t address, Kind& kind);

  Statement put_end_, put_fate_, put_delivery_;
  std::vector<std::string> topics_;
  std::map<std::string, std::uint32_t, std::less<>> topic_numbers_;
  std::vector<Sender> senders_;  ///< By address.
  std::uint64_t counted_ = 0;    ///< Additions to counts since the last write().
  std::uint64_t changed_ = 0;    ///< Estimate of the rows that write() would write.
};

}  // namespace results::record
