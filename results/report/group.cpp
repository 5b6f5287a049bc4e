#include "results/report/group.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hal/types/math.h"
#include "hal/types/verdict.h"
#include "results/report/paper.h"

namespace results::report {
namespace {

RobotDrive drive_of(const RunResult& run, const RunResult::Agent& robot,
                    const RunResult::Body& body) {
  RobotDrive drive{.robot = robot.name,
                   .path = body.path,
                   .straight = hal::math::hypot(body.x - robot.x, body.y - robot.y),
                   .clearance = body.clearance,
                   .wall_steps = body.wall_steps,
                   .object_steps = body.object_steps};
  for (const RunResult::Agent& agent : run.agents) {
    if (agent.agent != run.goal || agent.agent == robot.agent) continue;
    drive.straight = hal::math::hypot(agent.x - robot.x, agent.y - robot.y);
    drive.has_goal = true;
  }
  return drive;
}

}  // namespace

std::optional<double> RobotDrive::ratio() const {
  constexpr double kSamePlace = 1e-6;  // m
  const double least = has_goal ? kSamePlace : std::max(kSamePlace, kLeastStraight * path);
  return straight > least ? std::optional(path / straight) : std::nullopt;
}

std::vector<RobotDrive> drives(const RunResult& run) {
  std::vector<RobotDrive> drives;
  for (const RunResult::Agent& agent : run.agents) {
    const auto body = run.bodies.find(agent.agent);
    if (agent.is_robot && body != run.bodies.end()) {
      drives.push_back(drive_of(run, agent, body->second));
    }
  }
  return drives;
}

std::vector<double> Group::discoveries() const {
  std::vector<double> pooled;
  for (const RunResult* run : runs) {
    for (const std::int64_t ns : run->discoveries_ns) {
      pooled.push_back(static_cast<double>(ns) * 1e-9);
    }
  }
  return pooled;
}

std::vector<double> Group::delays() const {
  std::vector<double> pooled;
  for (const RunResult* run : runs) {
    for (const RunResult::Delivery& delivery : run->deliveries) pooled.push_back(delivery.delay);
  }
  return pooled;
}

std::uint64_t LinkSums::sent() const {
  std::uint64_t sum = 0;
  for (const auto& [verdict, count] : verdicts) sum += count;
  return sum;
}

std::uint64_t LinkSums::delivered() const {
  const auto found = verdicts.find(std::string(hal::name(hal::Verdict::kDelivered)));
  return found == verdicts.end() ? 0 : found->second;
}

std::map<std::string, FrameSums> Group::frame_verdicts() const {
  std::map<std::string, FrameSums> sums;
  for (const RunResult* run : runs) {
    for (const RunResult::FrameVerdict& one : run->frame_verdicts) {
      FrameSums& sum = sums[one.verdict];
      const bool to_everyone = one.kind == "broadcast" || one.kind == "beacon";
      (!one.addressed ? sum.to_others : to_everyone ? sum.to_everyone : sum.to_it) += one.count;
    }
  }
  return sums;
}

std::vector<LinkSums> Group::link_verdicts() const {
  std::map<std::pair<int, int>, LinkSums> links;
  for (const RunResult* run : runs) {
    for (const RunResult::LinkVerdict& one : run->link_verdicts) {
      LinkSums& link = links[{one.from, one.to}];
      link.from = one.from;
      link.to = one.to;
      link.verdicts[one.verdict] += one.count;
    }
  }
  std::vector<LinkSums> all;
  all.reserve(links.size());
  for (auto& [pair, link] : links) all.push_back(std::move(link));
  return all;
}

std::vector<RobotDrive> Group::all_drives() const {
  std::vector<RobotDrive> all;
  for (const RunResult* run : runs) {
    const std::vector<RobotDrive> some = drives(*run);
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

std::map<int, std::uint64_t> Group::packets() const {
  std::map<int, std::uint64_t> sums;
  for (const RunResult* run : runs) {
    for (const RunResult::Agent& agent : run->agents) sums[agent.agent] += 0;
    for (const auto& [agent, count] : run->packets) sums[agent] += count;
  }
  return sums;
}

std::optional<double> replica_score(const std::optional<Quantiles>& discovery,
                                    const std::optional<Quantiles>& delay) {
  if (!discovery || !delay) return std::nullopt;
  const auto misfit = [](const Quantiles& ours, const Quantiles& theirs) {
    return std::abs(hal::math::log(ours.q1 / theirs.q1)) +
           std::abs(hal::math::log(ours.median / theirs.median)) +
           std::abs(hal::math::log(ours.q3 / theirs.q3));
  };
  const double sum = misfit(*discovery, paper::kDiscovery) + misfit(*delay, paper::kDelay);
  return std::isfinite(sum) ? std::optional(sum / 6) : std::nullopt;
}

}  // namespace results::report
