#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "results/report/group.h"

namespace results::report {

/// What an access point did with what it had to pass on to one agent, over all runs of a group.
struct RelaySums {
  std::string access_point, destination;          ///< Names; "everyone".
  std::map<std::string, std::uint64_t> verdicts;  ///< As in the table relays.
  std::uint64_t queued = 0, most = 0;             ///< As in relay_queues: `frames`, `most`.
  std::int64_t waited_ns = 0;

  std::uint64_t came() const;
  std::uint64_t count(const std::string& verdict) const;
};
/// By access point and destination, in the order of their addresses.
std::vector<RelaySums> relay_sums(const Group& group);

/// Samples that did not come, over all runs of a group, by topic, verdict and whose frame or queue
/// it was: a name, "" for what is unknown.
using SampleLossSums = std::map<std::tuple<std::string, std::string, std::string>, std::uint64_t>;
SampleLossSums sample_loss_sums(const Group& group);

}  // namespace results::report
