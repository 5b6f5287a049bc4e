#include "baraka/run/network/network_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "results/statistics/interval.h"

namespace baraka::run::network {
namespace {

using sim::agents::EdgeSummary;

constexpr double kMostLate = 0.01;  ///< Share of frames.
/// With fewer frames, a warning is given only if most are late: frames are late in groups, but the
/// interval below assumes independent frames.
constexpr std::uint64_t kEnoughFrames = 100;
constexpr double kMostOfFew = 0.5;  ///< Share of frames.

double late_share(const EdgeSummary& edge) {
  if (edge.frames == 0) return 0;
  return static_cast<double>(edge.beyond_limit) / static_cast<double>(edge.frames);
}

/// Lower bound of the share of late frames: the lower end of Wilson's 95 % interval.
double least_late_share(const EdgeSummary& edge) {
  using results::statistics::Support;
  const std::array shares{late_share(edge), late_share(edge)};
  const Support support{Support::Kind::kShare, static_cast<double>(edge.frames)};
  return results::statistics::mean_interval(shares, support).value().low;
}

bool is_too_late(const EdgeSummary& edge) {
  if (edge.frames < kEnoughFrames) return late_share(edge) > kMostOfFew;
  return least_late_share(edge) > kMostLate;
}

void print_edge(const char* name, const EdgeSummary& edge) {
  fmt::print("{0}_frames: {1}\n{0}_late_share: {2:.6f}\n", name, edge.frames, late_share(edge));
  fmt::print("{}_lateness_median_s: {:.9f}\n", name, hal::to_seconds(edge.median));
  fmt::print("{}_lateness_p99_s: {:.9f}\n", name, hal::to_seconds(edge.p99));
  fmt::print("{}_lateness_max_s: {:.9f}\n", name, hal::to_seconds(edge.greatest));
}

std::string icmp_warning(const NetworkSummary::ByAgent& not_sent) {
  constexpr std::size_t kMostNames = 5;
  NetworkSummary::ByAgent most = not_sent;
  std::ranges::stable_sort(most, std::ranges::greater{},
                           [](const auto& one) { return one.second; });
  std::uint64_t sum = 0;
  for (const auto& [agent, count] : most) sum += count;
  std::string names;
  for (std::size_t i = 0; i < std::min(kMostNames, most.size()); ++i)
    names += fmt::format("{}{}: {}", i == 0 ? "" : ", ", most[i].first, most[i].second);
  return fmt::format(
      "the kernel never sent {} ICMP messages ({}{}): errors such as port unreachable, and answers "
      "to pings; all agents and runs of this computer share its sockets for ICMP, which take no "
      "more while errors wait for the addresses of neighbours",
      sum, names, most.size() > kMostNames ? ", ..." : "");
}

/// What was lost between programs and the air.
void add_losses(const NetworkSummary& network, std::vector<std::string>& lines) {
  if (network.frames_dropped > 0) {
    lines.push_back(
        fmt::format("the kernel dropped {} frames of programs before they came on the air: this "
                    "result is not what the radio would have given",
                    network.frames_dropped));
  }
  if (network.frames_not_taken > 0) {
    lines.push_back(
        fmt::format("{} frames from the air were lost because their agent's wlan0 was shut down",
                    network.frames_not_taken));
  }
  if (network.neighbours_without_room > 0) {
    lines.push_back(fmt::format(
        "the kernel's table of neighbours, which all agents and runs of this computer share, was "
        "full {} times: addresses were not found, and packets not sent; let it hold the square of "
        "the number of agents: sysctl net.ipv4.neigh.default.gc_thresh3, and "
        "net.ipv6.neigh.default.gc_thresh3",
        network.neighbours_without_room));
  }
  if (!network.icmp_not_sent.empty()) lines.push_back(icmp_warning(network.icmp_not_sent));
}

void print_held(const LockstepSummary& held) {
  fmt::print("program_turns: {}\nprogram_waits_ended: {}\nprogram_spins: {}\n", held.counts.turns,
             held.counts.expired, held.spins);
  fmt::print("program_unknown_waits: {}\n", held.counts.unknown);
}

}  // namespace

std::vector<std::string> network_warnings(const sim::agents::AirSummary& air,
                                          const NetworkSummary& network, double factor,
                                          hal::Duration limit) {
  std::vector<std::string> lines;
  const auto judge = [&](const EdgeSummary& edge, const char* what) {
    if (!is_too_late(edge)) return;
    if (edge.frames < kEnoughFrames) {
      lines.push_back(fmt::format("{} of the {} frames that {} were more than {} ms late",
                                  edge.beyond_limit, edge.frames, what,
                                  1e3 * hal::to_seconds(limit)));
      return;
    }
    lines.push_back(fmt::format(
        "this computer was too slow for this run: {:.1f} % of the frames that {} were more than "
        "{} ms late; a smaller F of --pace realtime:F gives it more time (now {})",
        100 * late_share(edge), what, 1e3 * hal::to_seconds(limit), factor));
  };
  judge(air.entering, "programs sent");
  judge(air.leaving, "programs received");
  add_losses(network, lines);
  if (air.has_seen_tcp && factor != 1) {
    lines.push_back(fmt::format(
        "programs used TCP at {} of real time: its timers are not slowed, so its results do not "
        "hold; take --pace realtime for it",
        factor));
  }
  return lines;
}

std::vector<std::string> held_network_warnings(const sim::agents::AirSummary& air,
                                               const NetworkSummary& network) {
  std::vector<std::string> lines;
  add_losses(network, lines);
  if (air.has_seen_tcp) {
    lines.push_back(
        "programs used TCP in lock-step: its timers are the kernel's and follow the wall clock: "
        "when "
        "a lost segment is sent again depends on this computer, and equal runs need not have equal "
        "frames; take --pace realtime for it");
  }
  if (network.lockstep && network.lockstep->counts.unknown > 0) {
    lines.push_back(
        fmt::format("{} waits of programs were in system calls that lock-step does not support, so "
                    "their ends depend on this computer",
                    network.lockstep->counts.unknown));
  }
  if (!network.ends_in_turns) {
    lines.push_back(
        "programs took too much wall time to end, and the rest ended all at once: what they wrote "
        "after the end of the run need not be equal in equal runs");
  }
  return lines;
}
void print_network(const sim::agents::AirSummary& air, const NetworkSummary& network) {
  if (network.lockstep) {
    print_held(*network.lockstep);
  } else {
    print_edge("entering", air.entering);
    print_edge("leaving", air.leaving);
  }
  for (const auto& [reason, frames] : air.refused) {
    fmt::print("frames_refused: {} ({})\n", frames, reason);
  }
  fmt::print("frames_dropped: {}\n", network.frames_dropped);
  fmt::print("cpu_load: {:.3f}\ncpu_load_programs: {:.3f}\n", network.cpu_load,
             network.cpu_load_programs);
  for (const results::record::ProgramRow& program : network.programs) {
    if (program.ended) {
      fmt::print("program: {} of {}: status {} at {:.9f} s\n", program.name, program.agent_name,
                 program.status, hal::to_seconds(*program.ended));
    } else {
      fmt::print("program: {} of {}: ended with the run\n", program.name, program.agent_name);
    }
  }
}

}  // namespace baraka::run::network
