#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "results/report/group.h"

namespace results::report {

/// What an access point did with the frames it had to relay to one agent, over all runs of a group.
struct RelaySums {
  std::string access_point, destination;          ///< Names; for broadcasts "everyone".
  std::map<std::string, std::uint64_t> verdicts;  ///< As in the table `relays`.
  std::uint64_t queued = 0, most = 0;  ///< As `frames` and `most` in the table `relay_queues`.
  std::int64_t waited_ns = 0;

  std::uint64_t came() const;
  std::uint64_t count(const std::string& verdict) const;
};
/// Sums by access point and destination, in the order of their addresses.
std::vector<RelaySums> relay_sums(const Group& group);

/// Name of an agent of the run, "everyone", or the number of an agent that it does not know.
std::string name_of(const RunResult& run, int agent);

/// Numbers of lost samples over all runs of a group, by topic, verdict and the name of the agent
/// whose frame or queue it was ("": unknown).
using SampleLossSums = std::map<std::tuple<std::string, std::string, std::string>, std::uint64_t>;
SampleLossSums sample_loss_sums(const Group& group);

}  // namespace results::report
