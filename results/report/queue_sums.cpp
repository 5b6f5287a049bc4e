#include "results/report/queue_sums.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "results/report/relay_sums.h"

namespace results::report {
namespace {

void add_to(QueueSums& sums, const RunResult& run, const RunResult::Queue& one) {
  sums.agent = name_of(run, one.agent);
  sums.receiver = name_of(run, one.receiver);
  sums.category = one.category;
  sums.all.frames += one.frames;
  sums.all.waiting += one.waiting;
  sums.all.most = std::max(sums.all.most, one.most);
  sums.all.most_bytes = std::max(sums.all.most_bytes, one.most_bytes);
  sums.all.waited_ns += one.waited_ns;
  for (const auto& [verdict, count] : one.drops) sums.all.drops[verdict] += count;
}

}  // namespace

std::uint64_t QueueSums::dropped(const std::string& verdict) const {
  const auto found = all.drops.find(verdict);
  return found == all.drops.end() ? 0 : found->second;
}

std::uint64_t QueueSums::dropped() const {
  std::uint64_t sum = 0;
  for (const auto& [verdict, count] : all.drops) sum += count;
  return sum;
}

std::vector<QueueSums> queue_sums(const Group& group) {
  std::map<std::tuple<int, int, std::string>, QueueSums> sums;
  for (const RunResult* run : group.runs) {
    for (const RunResult::Queue& one : run->queues) {
      add_to(sums[{one.agent, one.receiver, one.category}], *run, one);
    }
  }
  std::vector<QueueSums> list;
  list.reserve(sums.size());
  for (auto& [key, one] : sums) list.push_back(std::move(one));
  return list;
}

}  // namespace results::report
