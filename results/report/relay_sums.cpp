#include "results/report/relay_sums.h"

#include <algorithm>
#include <utility>

#include "hal/types/agent_id.h"

namespace results::report {
std::string name_of(const RunResult& run, int agent) {
  const auto found = std::ranges::find(run.agents, agent, &RunResult::Agent::agent);
  if (found != run.agents.end()) return found->name;
  return agent == hal::kEveryone.value ? "everyone" : std::to_string(agent);
}

std::uint64_t RelaySums::came() const {
  std::uint64_t sum = 0;
  for (const auto& [verdict, count] : verdicts) sum += count;
  return sum;
}

std::uint64_t RelaySums::count(const std::string& verdict) const {
  const auto found = verdicts.find(verdict);
  return found == verdicts.end() ? 0 : found->second;
}

std::vector<RelaySums> relay_sums(const Group& group) {
  std::map<std::pair<int, int>, RelaySums> sums;
  for (const RunResult* run : group.runs) {
    for (const RunResult::Relay& one : run->relays) {
      RelaySums& sum = sums[{one.access_point, one.destination}];
      sum.access_point = name_of(*run, one.access_point);
      sum.destination = name_of(*run, one.destination);
      for (const auto& [verdict, count] : one.verdicts) sum.verdicts[verdict] += count;
      sum.queued += one.queued;
      sum.most = std::max(sum.most, one.most);
      sum.waited_ns += one.waited_ns;
    }
  }
  std::vector<RelaySums> all;
  all.reserve(sums.size());
  for (auto& [key, sum] : sums) all.push_back(std::move(sum));
  return all;
}

SampleLossSums sample_loss_sums(const Group& group) {
  SampleLossSums sums;
  for (const RunResult* run : group.runs) {
    for (const RunResult::SampleLossCount& one : run->sample_losses) {
      const std::string at = one.agent == 0 ? "" : name_of(*run, one.agent);
      sums[{one.topic, one.verdict, at}] += one.count;
    }
  }
  return sums;
}

}  // namespace results::report
