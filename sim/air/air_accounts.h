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

/// Counts of results at one radio: of frames, and of their contents.
struct AirEnds {
  std::uint64_t frames = 0;  ///< Frames counted as this kind.
  std::uint64_t parts = 0;   ///< Frames that carried a part of this kind.
};

/// Transmissions of one kind by one transmitter.
struct AirAccount {
  hal::AgentId transmitter;
  AirKind kind;
  std::uint64_t frames = 0;   ///< Frames whose largest part is of this kind.
  std::uint64_t retries = 0;  ///< Those of `frames` that are retransmissions.
  /// Submessages that begin in first transmissions; of kinds without submessages: frames.
  std::uint64_t submessages = 0;
  std::uint64_t repeated = 0;  ///< The same in retransmissions.
  std::uint64_t bits = 0;      ///< The share of this kind in the bits of MPDUs.
  hal::Duration airtime{};     ///< The share of this kind in the air time.
  bool changed = false;        ///< Since the account was last written.

  /// Results at one receiver by verdict; [1]: frames addressed to it or to everyone.
  struct Ends {
    hal::AgentId receiver;
    std::array<std::array<AirEnds, hal::kVerdictCount>, 2> ends{};
    bool changed = false;
  };
  std::vector<std::unique_ptr<Ends>> at{};  ///< By the receiver's number; null: no results.
};

/// The share of one writer, for one kind of submessage and one transmitter.
struct WriterAccount {
  hal::AgentId transmitter;
  EndpointIndex writer = 0;
  AirKind kind;
  std::uint64_t submessages = 0, repeated = 0, bits = 0;
  hal::Duration airtime{};
  bool changed = false;
};

/// Accounts of air time. Each frame, with headers and preamble, is divided among its contents in
/// proportion to their octets; the remainder of a whole number of bits or nanoseconds goes to the
/// largest fractions (Hamilton's method; ties go to the first). The frame itself is counted once,
/// as its largest part. The sums over all accounts of a transmitter therefore equal the values of
/// its radio exactly.
class AirAccounts {
 public:
  /// The accounts of a piece of a frame, and its share.
  struct Share {
    std::uint32_t account = 0, writer = 0;  ///< Indices into all() and writers().
    std::int64_t bits = 0, airtime_ns = 0;
  };
  using Shares = std::vector<Share>;
  /// A transmission to be divided.
  struct Sent {
    hal::AgentId transmitter;
    bool is_retry = false;
    std::int64_t bits = 0;
    hal::Duration airtime{};
  };

  /// Adds a transmission. @param[in,out] shares  as made by open() for this content.
  void add(const Content& content, const Sent& sent, Shares& shares);
  /// Finds or adds the accounts of a content's pieces.
  void open(const Content& content, hal::AgentId transmitter, Shares& shares);
  /// Reduces the air time of a transmission with these shares, which was cut off after `airtime`.
  void cut(const Content& content, hal::Duration airtime, Shares& shares);
  void add_end(const Content& content, const Shares& shares, hal::AgentId receiver, bool addressed,
               hal::Verdict verdict);

  /// Number of accounts, writers and results that changed since reset_changes().
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
  std::vector<std::uint32_t> numbers_;  ///< Numbers of receivers, by address; 0: none yet.
  std::uint32_t receivers_ = 0;  ///< Number of receivers that have a number; numbers start at 1.
  std::map<Key, std::uint32_t> places_;
  std::map<std::pair<EndpointIndex, Key>, std::uint32_t> writer_places_;
};

/// Divides a whole number in proportion to the pieces' octets, by largest remainder.
/// @param[out] parts  one for each piece; their sum is `whole`.
void share_out(std::int64_t whole, std::span<const Piece> pieces, std::vector<std::int64_t>& parts);

}  // namespace sim::air
