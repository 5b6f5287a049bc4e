#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"

namespace sim {

/// What of a run a hash speaks of.
enum class Part : std::uint8_t {
  kAir,       ///< Frame starts and bytes, verdict and power of every reception.
  kBodies,    ///< Pose of every agent at its control instants.
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
  void add(std::string_view text);
  void add_bytes(const void* data, std::size_t size);
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325u;
};

/// Fingerprint of a run: a hash per part, agent and simulated second, so that two runs can be told
/// apart to the agent and second. Not fed: wall time, process names, sequence numbers.
class Fingerprint {
 public:
  /// Where the values of one observation at `time` go; the time itself is already in.
  Hash& at(Part part, hal::AgentId agent, hal::Time time);

  struct Row {
    std::int64_t second;
    Part part;
    hal::AgentId agent;
    std::uint64_t hash;
  };
  /// By second, part, agent.
  std::vector<Row> rows() const;

  /// Of each part over the whole run, of one of them, and of all four.
  std::array<std::uint64_t, kPartCount> parts() const;
  std::uint64_t part(Part part) const { return parts()[static_cast<std::size_t>(part)]; }
  std::uint64_t total() const;

 private:
  struct Current {
    std::int64_t second = 0;
    Hash* hash = nullptr;
  };

  std::map<std::tuple<std::int64_t, Part, hal::AgentId>, Hash> hashes_;
  std::array<std::vector<Current>, kPartCount> current_;  ///< By address; saves the big look-up.
};

/// 16 hexadecimal digits.
std::string to_hex(std::uint64_t value);

}  // namespace sim
