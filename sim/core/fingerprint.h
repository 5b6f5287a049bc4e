#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"

namespace sim {

/// Part of a run that a hash covers.
enum class Part : std::uint8_t {
  kAir,       ///< Frame starts and bytes, verdict and power of every reception.
  kBodies,    ///< Pose of each agent at its control instants, and of the movables that moved.
  kExchange,  ///< Events and actions.
  kRouting,   ///< Route changes.
};
inline constexpr int kPartCount = 4;
std::string_view name(Part part);

/// 64-bit hash of a sequence of values; order matters. Not cryptographic: each value is multiplied
/// and folded (the mixing step of SplitMix64, Steele, Lea, Flood, 2014).
class Hash {
 public:
  void add(std::uint64_t value) {
    state_ = (state_ ^ value) * 0x9fb21c651e98df25u;
    state_ ^= state_ >> 32;
  }
  void add(std::int64_t value) { add(static_cast<std::uint64_t>(value)); }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(std::string_view text) { add_bytes(text.data(), text.size()); }
  void add_bytes(const void* data, std::size_t size);
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325u;
};

/// Fingerprint of a run: a hash per part, agent and simulated second, so that a difference between
/// two runs can be located to the agent and second. It excludes wall time, process names and
/// sequence numbers.
///
/// Each second is hashed twice: with the times of its observations since the start of the run, for
/// the totals, and with their times within the second, for the rows. A second that equals the one
/// before needs no row, so a run with little activity has few rows. Seconds are passed on as they
/// end; the memory needed does not grow with the run.
class Fingerprint {
 public:
  /// Hash of one agent's second.
  class Cell {
   public:
    template <class Value>
    void add(const Value& value) {
      since_start_.add(value);
      within_second_.add(value);
    }
    void add(std::string_view text) { add_bytes(text.data(), text.size()); }
    void add_bytes(const void* data, std::size_t size);

   private:
    friend class Fingerprint;
    Hash since_start_, within_second_;
    bool is_used_ = false;
  };

  /// From this second on, until the next row of the same part and agent, each second has this hash.
  /// Without a hash, nothing was observed.
  struct Row {
    std::int64_t second = 0;
    Part part{};
    hal::AgentId agent{};
    std::optional<std::uint64_t> hash;
    bool operator==(const Row&) const = default;
  };

  /// Longest time by which an event may be reported late: the longest controller latency. Later
  /// reports (real time, a busy controller) count for the oldest second that is still open.
  static constexpr std::int64_t kLateness = 10;  // s

  /// @param sink  gets the rows by second, part, agent; may throw.
  explicit Fingerprint(std::function<void(const Row&)> sink = [](const Row&) {})
      : sink_(std::move(sink)) {}
  Fingerprint(const Fingerprint&) = delete;
  Fingerprint& operator=(const Fingerprint&) = delete;

  /// Cell to which the values of one observation at `time` are to be added; the time is added here.
  Cell& at(Part part, hal::AgentId agent, hal::Time time);

  /// Ends the run: passes on the seconds that are still open.
  void finish();

  /// Hashes of the run so far: of each part, of one part, and of all four.
  std::array<std::uint64_t, kPartCount> parts() const;
  std::uint64_t part(Part part) const { return parts()[static_cast<std::size_t>(part)]; }
  std::uint64_t total() const;

 private:
  static constexpr std::int64_t kSecond = 1'000'000'000;  ///< ns

  using Sums = std::array<Hash, kPartCount>;
  template <class T>
  using Table = std::array<std::vector<T>, kPartCount>;  ///< By part and address.
  using Second = Table<Cell>;

  /// Calls visit(part, agent, cell) for what was observed in a second.
  template <class Visit>
  static void for_each(const Second& second, Visit visit);
  static void add(Sums& sums, std::int64_t second, const Second& observed);
  void open_second_of(std::int64_t ns);
  void close_before(std::int64_t second);
  void hand_over(std::int64_t number, const Second& second);
  void end_rows(std::int64_t second);

  std::function<void(const Row&)> sink_;
  std::deque<Second> open_;        ///< Consecutive seconds; empty if nothing was observed.
  std::int64_t first_open_ = 0;    ///< Number of the first open second.
  std::size_t largest_ = 0;        ///< Most cells that a part of one second had.
  Second* recent_ = nullptr;       ///< That of the last observation; null if it is closed.
  std::int64_t recent_begin_ = 0;  ///< ns
  Sums sums_;                      ///< Hashes of the seconds passed on.
  /// Hash of the last second of each part and agent.
  Table<std::optional<std::uint64_t>> last_;
};

/// 16 hexadecimal digits.
std::string to_hex(std::uint64_t value);

}  // namespace sim
