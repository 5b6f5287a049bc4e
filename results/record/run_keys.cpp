#include <algorithm>
#include <array>

#include "results/record/schema.h"

namespace results::record {
namespace {

/// Keys of runs whose agents have networks.
std::vector<RunKey> network_run_keys() {
  return {
      {"entering_frames", "", "with networks: frames that came from programs"},
      {"entering_late_frames", "", "with networks: of those, later than lateness_limit"},
      {"entering_lateness_median_s", "s",
       "with networks, simulated time: upper bound of how long frames waited before they entered"},
      {"entering_lateness_p99_s", "s", "99 % are not later"},
      {"entering_lateness_max_s", "s", "greatest"},
      {"leaving_frames", "", "with networks: frames that went to programs"},
      {"leaving_late_frames", "", "with networks: of those, later than lateness_limit"},
      {"leaving_lateness_median_s", "s",
       "with networks, simulated time: from the end of a frame's reception to its program"},
      {"leaving_lateness_p99_s", "s", "99 % are not later"},
      {"leaving_lateness_max_s", "s", "greatest"},
      {"frames_dropped", "",
       "with networks: frames dropped by the kernel before they entered; must be 0"},
      {"frames_not_taken", "",
       "with networks: frames from the air that an interface refused because it was shut down"},
      {"icmp_not_sent", "",
       "with networks: ICMP messages that the kernel was to send and did not, see warnings"},
      {"cpu_load", "", "with networks: processor time of baraka over wall time"},
      {"cpu_load_programs", "",
       "with networks: processor time of all programs inside agents over wall time"},
      {"program_turns", "", "programs in lock-step: how often a thread of theirs went on"},
      {"program_waits_ended", "", "programs in lock-step: waits that ended at their deadline"},
      {"program_spins", "",
       "programs in lock-step: how often a thread that only looked at the clock was put to sleep"},
      {"program_unknown_waits", "",
       "programs in lock-step: waits in calls that lock-step does not know, where they are "
       "allowed"},
      {"warnings", "", "with networks: reasons to doubt this result, one per line"},
      {"open_loop", "", "of a repetition: the settings that differ from the recorded run"},
  };
}

std::vector<RunKey> all_run_keys() {
  std::vector<RunKey> keys = {
      {"run_id", "", "128 random bits, also in the marker of the folder"},
      {"result", "",
       "'running' until the run has ended; then as the scenario calls it, 'until', 'interrupted', "
       "'failed', or 'not started'"},
      {"error", "", "why it failed or did not start"},
      {"exit_status", "", "of the program; missing until the run has ended"},
      {"scenario", "", "its name"},
      {"version", "", "of baraka"},
      {"seed", "", "of the random streams"},
      {"profile", "", "of the radio"},
      {"pace", "", "'lockstep', 'realtime', 'realtime:<factor>', or 'repeated' from a record"},
      {"controller_latency_s", "s", "from an event until the controller's answer takes effect"},
      {"control_phase", "", "'aligned' or 'uniform'"},
      {"control_period_s", "s", "of the scenario"},
      {"ended_ns", "ns", "simulated time"},
      {"simulated_s", "s", "the same"},
      {"wall_s", "s", "real time from START to the last event"},
      {"events", "", "of the simulator"},
      {"exchanges", "", "with controllers"},
      {"refused_actions", "", "of controllers, dropped"},
      {"ode_messages", "", "warnings of the physics engine"},
      {"fingerprint", "", "of everything observed, 64 bits in hexadecimal"},
      {"fingerprint_air", "", "of frames and receptions"},
      {"fingerprint_bodies", "", "of poses at control instants"},
      {"fingerprint_exchange", "", "of events and actions"},
      {"fingerprint_routing", "", "of route changes"},
      {"frames_digest", "",
       "of all frames in the order in which they were sent: times, addresses, rates, lengths and "
       "the "
       "bytes of their payloads; 64 bits in hexadecimal"},
      {"overruns", "", "in real time: steps that came too late"},
      {"missed_cycles", "", "in real time: control cycles without an answer in time"},
      {"command_timeouts", "",
       "in real time: times that wheels were stopped because no action came"},
      {"lost_events", "",
       "in real time: events dropped because too many waited while a controller was busy"},
      {"control_jitter_median_s", "s", "in real time: lateness of control cycles"},
      {"control_jitter_p99_s", "s", "99 % are not later"},
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
