#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "results/record/run_reader.h"

namespace results::record {

/// How two runs compare: what was run, how it ended, and where what happened begins to differ.
///
///   RunReader one(folder), other(other_folder);
///   const RunDifference difference = compare_runs(one, other);
///   if (!difference.is_equal()) …
struct RunDifference {
  /// A key of the table run, or a setting, with its values; "" where a run does not have it.
  struct Key {
    std::string name, first, second;
    bool is_equal() const { return first == second; }
    /// Whether both runs have it.
    bool is_known() const { return !first.empty() && !second.empty(); }
  };
  /// Part, agent and second of the first row of the table fingerprints that differs.
  struct Hash {
    std::int64_t second = 0;
    std::string part, agent;
  };
  /// The first row that differs, of the tables arrivals, frames and frame_ends.
  struct Happening {
    std::int64_t at_ns = 0;          ///< Simulated time; of the two the earlier.
    std::string table;               ///< "frames"
    std::string stations, protocol;  ///< "m3 to r0", "IPv4 UDP 40000 > 5000"; both if they differ.
    std::string what;                ///< "retry 0 | 1"; "" if only one run has such a row.
    std::string before;              ///< The row before it, which both have; "": there is none.
    std::string first, second;       ///< The rows; "": this run has no more.
  };

  std::vector<Key> causes;    ///< What was run: scenario, seed, version, pace.
  std::vector<Key> settings;  ///< Only those that differ.
  std::vector<Key> outcomes;  ///< What came of it: result, end, fingerprint, digest.
  std::optional<Hash> hash;
  std::optional<Happening> happening;
  std::vector<std::string> notes;  ///< What could not be compared, and what to record for it.

  /// Whether the same happened in both runs, as far as both records tell. What was run does not
  /// count: a repetition has another pace, and a setting may have no effect.
  bool is_equal() const;
};

/// @throws std::runtime_error  as RunReader.
RunDifference compare_runs(RunReader& one, RunReader& other);

}  // namespace results::record
