#include <algorithm>
#include <array>

#include "results/record/schema.h"

namespace results::record {
namespace {

/// Keys of runs whose agents have networks.
std::vector<RunKey> network_run_keys() {
  return {
      {"entering_frames", "", "with networks: frames that came from programs"},
      {"entering_late_frames", "",
       "with networks: frames among these that were later than lateness_limit"},
      {"entering_lateness_median_s", "s",
       "with networks, simulated time: upper bound of the time that frames waited before they "
       "entered"},
      {"entering_lateness_p99_s", "s", "99th percentile"},
      {"entering_lateness_max_s", "s", "greatest"},
      {"leaving_frames", "", "with networks: frames that went to programs"},
      {"leaving_late_frames", "",
       "with networks: frames among these that were later than lateness_limit"},
      {"leaving_lateness_median_s", "s",
       "with networks, simulated time: from the end of a frame's reception to its delivery to a "
       "program"},
      {"leaving_lateness_p99_s", "s", "99th percentile"},
      {"leaving_lateness_max_s", "s", "greatest"},
      {"frames_dropped", "",
       "with networks: frames dropped by the kernel before they entered; must be 0"},
      {"frames_not_taken", "",
       "with networks: frames from the air that an interface refused because it was shut down"},
      {"icmp_not_sent", "",
       "with networks: ICMP messages that the kernel should have sent and did not, see warnings"},
      {"cpu_load", "", "with networks: processor time of baraka over wall time"},
      {"cpu_load_programs", "",
       "with networks: processor time of all programs inside agents over wall time"},
      {"program_turns", "",
       "programs in lock-step: number of times that one of their threads was resumed"},
      {"program_waits_ended", "", "programs in lock-step: waits that ended at their deadline"},
      {"program_spins", "",
       "programs in lock-step: number of times that a thread which only polled the clock was put "
       "to sleep"},
      {"program_unknown_waits", "",
       "programs in lock-step: waits in system calls that lock-step does not support "
       "(unknown_waits: allow)"},
      {"warnings", "", "with networks: reasons to doubt this result, one per line"},
      {"open_loop", "", "of a repeated run (--repeat): settings that differ from the recorded run"},
  };
}

std::vector<RunKey> all_run_keys() {
  std::vector<RunKey> keys = {
      {"run_id", "", "128 random bits, also in the marker of the folder"},
      {"result", "",
       "'running' until the run has ended; then the result that the scenario names, 'until', "
       "'interrupted', 'failed', or 'not started'"},
      {"error", "", "reason why it failed or did not start"},
      {"exit_status", "", "exit status of baraka; missing until the run has ended"},
      {"scenario", "", "name of the scenario"},
      {"version", "", "version of baraka"},
      {"seed", "", "seed of the random streams"},
      {"profile", "", "profile of the radio"},
      {"pace", "", "'lockstep', 'realtime', 'realtime:<factor>', or 'repeated' from a record"},
      {"controller_latency_s", "s", "time from an event to the effect of the controller's answer"},
      {"control_phase", "", "'aligned' or 'uniform'"},
      {"control_period_s", "s", "control period of the scenario"},
      {"ended_ns", "ns", "simulated time at the end"},
      {"simulated_s", "s", "the same"},
      {"wall_s", "s", "real time from START to the last event"},
      {"events", "", "events that the simulator processed"},
      {"exchanges", "", "exchanges with controllers"},
      {"refused_actions", "", "actions of controllers that were rejected"},
      {"ode_messages", "", "warnings of the physics engine"},
      {"fingerprint", "", "hash of everything observed, 64 bits in hexadecimal"},
      {"fingerprint_air", "", "hash of frames and receptions"},
      {"fingerprint_bodies", "", "hash of poses at control instants"},
      {"fingerprint_exchange", "", "hash of events and actions"},
      {"fingerprint_routing", "", "hash of route changes"},
      {"frames_digest", "",
       "hash of all frames in the order in which they were sent: times, addresses, rates, lengths "
       "and the bytes of their payloads; 64 bits in hexadecimal"},
      {"overruns", "", "in real time: steps that were late"},
      {"missed_cycles", "", "in real time: control cycles without an answer in time"},
      {"command_timeouts", "",
       "in real time: number of times that wheels were stopped because no action arrived"},
      {"lost_events", "",
       "in real time: events dropped because too many waited while a controller was busy"},
      {"control_jitter_median_s", "s", "in real time: lateness of control cycles"},
      {"control_jitter_p99_s", "s", "99th percentile"},
      {"control_jitter_max_s", "s", "greatest"},
  };
  const std::vector<RunKey> networks = network_run_keys();
  keys.insert(keys.end(), networks.begin(), networks.end());
  return keys;
}

}  // namespace

const std::vector<RunKey>& run_keys() {
  static const std::vector<RunKey> keys = all_run_keys();
  return keys;
}

bool is_count(const RunKey& key) {
  static constexpr std::array<std::string_view, 19> kCounts{
      "program_unknown_waits", "exit_status",         "events",          "exchanges",
      "refused_actions",       "ode_messages",        "overruns",        "missed_cycles",
      "command_timeouts",      "lost_events",         "entering_frames", "leaving_frames",
      "entering_late_frames",  "leaving_late_frames", "frames_dropped",  "frames_not_taken",
      "program_turns",         "program_waits_ended", "program_spins"};
  return std::ranges::find(kCounts, key.name) != kCounts.end();
}

}  // namespace results::record
