#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"
#include "hal/types/verdict.h"
#include "sim/air/content.h"

namespace sim::air {

/// How frames, or their contents, ended at one radio.
struct AirEnds {
  std::uint64_t frames = 0;  ///< Counted as this kind.
  std::uint64_t parts = 0;   ///< That carried some of it.
};

/// Transmissions of one kind by one transmitter.
struct AirAccount {
  hal::AgentId transmitter;
  AirKind kind;
  std::uint64_t frames = 0;       ///< Whose largest part is of this kind.
  std::uint64_t retries = 0;      ///< So many of these were sent before.
  std::uint64_t submessages = 0;  ///< That begin in frames sent for the first time …
  std::uint64_t repeated = 0;     ///< … and in retries. Of what has no parts: frames.
  std::uint64_t bits = 0;         ///< Of the MPDUs: the share of this kind.
  hal::Duration airtime{};        ///< Likewise.
  bool changed = false;           ///< Since they were last written.

  /// By receiver and verdict, [1]: those to it or to everyone.
  struct Ends {
    hal::AgentId receiver;
    std::array<std::array<AirEnds, hal::kVerdictCount>, 2> ends{};
    bool changed = false;
  };
  std::vector<std::unique_ptr<Ends>> at{};  ///< By the receiver's number; null: nothing.
};

/// One writer's share, by kind of submessage and transmitter.
struct WriterAccount {
  hal::AgentId transmitter;
  EndpointIndex writer = 0;
  AirKind kind;
  std::uint64_t submessages = 0, repeated = 0, bits = 0;
  hal::Duration airtime{};
  bool changed = false;
};

/// Accounts of air time. Each frame, with headers and preamble, is divided among its contents in
/// proportion to their octets; the rest of a whole number of bits or nanoseconds goes to the
/// largest remainders (Hamilton's method; the first of equal ones gets it). The frame itself is
/// counted once, as its largest part. The sums over all accounts of a transmitter therefore equal
/// the numbers of its radio exactly.
class AirAccounts {
 public:
  /// Accounts of a frame's shares.
  struct Share {
    std::uint32_t account = 0, writer = 0;  ///< Places in all() and writers().
    std::int64_t bits = 0, airtime_ns = 0;
  };
  using Shares = std::vector<Share>;
  /// What is shared out.
  struct Sent {
    hal::AgentId transmitter;
    bool is_retry = false;
    std::int64_t bits = 0;
    hal::Duration airtime{};
  };

  /// @param[in,out] shares  as open() made them for this content.
  void add(const Content& content, const Sent& sent, Shares& shares);
  /// The accounts of a content's pieces.
  void open(const Content& content, hal::AgentId transmitter, Shares& shares);
  /// A frame of these shares was cut after this time on the air.
  void cut(const Content& content, hal::Duration airtime, Shares& shares);
  void add_end(const Content& content, const Shares& shares, hal::AgentId receiver, bool addressed,
               hal::Verdict verdict);

  /// How many accounts, writers and ends changed since the last reset.
  std::uint64_t changes() const { return changes_; }
  void reset_changes() { changes_ = 0; }

  std::vector<AirAccount>& all() { return all_; }
  const std::vector<AirAccount>& all() const { return all_; }
  std::vector<WriterAccount>& writers() { return writers_; }
  const std::vector<WriterAccount>& writers() const { return writers_; }

 private:
  using Key = std::pair<hal::AgentId, AirKind>;

  std::size_t number_of(hal::AgentId receiver);
  void note(bool& changed) {
    changes_ += changed ? 0 : 1;
    changed = true;
  }

  std::vector<AirAccount> all_;
  std::vector<WriterAccount> writers_;
  std::uint64_t changes_ = 0;
  std::vector<std::uint32_t> numbers_;  ///< Of receivers, by address; 0: not heard of.
  std::uint32_t receivers_ = 0;         ///< That have a number: from 1 on.
  std::map<Key, std::uint32_t> places_;
  std::map<std::pair<EndpointIndex, Key>, std::uint32_t> writer_places_;
};

/// Splits a whole number in proportion to the pieces' octets, by largest remainder.
/// @param[out] parts  as many as there are pieces; their sum is `whole`.
void share_out(std::int64_t whole, std::span<const Piece> pieces, std::vector<std::int64_t>& parts);

}  // namespace sim::air
