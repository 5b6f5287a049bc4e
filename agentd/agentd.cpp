#include "agentd/agentd.h"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <random>
#include <utility>
#include <variant>

#include "agentd/emergency_latch.h"
#include "agentd/inspection.h"
#include "agentd/radio.h"
#include "agentd/readiness.h"
#include "agentd/service_notice.h"
#include "gateway/inspection/emergency_stop_reader.h"
#include "gateway/process/exit_status.h"
#include "gateway/server/server.h"
#include "gateway/server/teleop_port.h"
#include "hal/robot/agent/hardware_agent.h"
#include "hal/robot/agent/loop_watch.h"
#include "hal/robot/platform/signal_thread.h"
#include "hal/robot/radio/udp_address.h"
#include "hal/types/log.h"
#include "hal/types/terminal_colours.h"

namespace agentd {
namespace {

using namespace std::chrono_literals;
using hal::robot::agent::RobotFile;
using hal::robot::agent::StopSource;
using hal::robot::platform::EventLoop;

constexpr std::uint64_t kOnlyRun = 1;
/// Maximum time for the wheels to confirm that they stand, and then for the controller to end.
constexpr hal::Duration kStopPatience = 500ms, kFarewell = 1s;
/// Period in which a controller in another container is checked for silence: it has no descriptor.
constexpr hal::Duration kAttendEvery = 200ms;
/// A loop that hangs longer must not drive a robot, however long the file lets it wait for its
/// controller.
constexpr hal::Duration kLongestHang = 400ms;

RobotFile load(const AgentdOptions& options) {
  RobotFile file = RobotFile::load(options.file, options.overrides);
  for (const std::string& warning : file.warnings) hal::print_line(hal::Tone::kWarning, warning);
  require_air_interface(file);
  // Other nodes remember the sequence numbers of this node's packets for a while, also when it
  // restarts.
  file.routing.first_sequence = std::random_device{}() >> 1U;
  return file;
}

/// Checked here because Fast DDS would continue without topics, including that of the emergency
/// stop.
std::string address_for_topics(const AgentdOptions& options) {
  try {
    hal::robot::radio::require_address(options.inspect_address);
  } catch (const std::runtime_error& error) {
    throw gateway::process::UsageError(fmt::format("--inspect-address: {}", error.what()));
  }
  return options.inspect_address;
}

/// Motes have nothing that could be stopped.
EmergencyLatch latch_for(const RobotFile& file, const AgentdOptions& options) {
  if (file.wheels == nullptr) return {};
  if (options.remembers) {
    return {file.name,
            options.state.empty() ? default_state_folder() : std::filesystem::path(options.state)};
  }
  hal::log::warning({}, file.name,
                    "an emergency stop is forgotten when the daemon restarts (--no-state)");
  return {};
}

/// All parts of one agent, in the order in which they must be made. Parts with threads are made
/// after the loop has taken over the signals.
class Agentd {
 public:
  explicit Agentd(const AgentdOptions& options);
  ~Agentd() { let_go_of_watches(); }
  Agentd(const Agentd&) = delete;
  Agentd& operator=(const Agentd&) = delete;

  int run();

 private:
  std::unique_ptr<hal::robot::agent::PoseSource> make_pose_source();
  hal::robot::agent::Devices devices() const;
  void drive_here();
  void stop_as_before();
  void set_emergency_stop(bool stop, StopSource source);

  void on_stop_signal(int signal);
  void on_end_signal();
  void attend();
  void attend_again();
  void let_go_of_watches();
  void beat();
  void stop();
  void print_ready() const;
  void print_summary() const;

  RobotFile file_;
  int domain_;
  EmergencyLatch latch_;
  EventLoop loop_;
  bool taking_signals_;
  gateway::inspection::InspectionParticipant participant_;
  std::unique_ptr<hal::robot::drivers::WheelDriver> wheels_;
  std::unique_ptr<hal::robot::drivers::InfraredDriver> infrared_;
  std::vector<std::unique_ptr<hal::robot::drivers::SensorDriver>> sensors_;
  std::unique_ptr<hal::robot::agent::PoseSource> pose_;
  hal::robot::radio::UdpLink link_;
  AgentInspection inspection_;
  hal::robot::agent::HardwareAgent agent_;
  std::optional<hal::robot::agent::LoopWatch> loop_watch_;  ///< None if there are no wheels.
  std::mutex latch_mutex_;
  std::optional<gateway::inspection::EmergencyStopReader> emergency_stop_;
  std::optional<hal::robot::platform::SignalThread> stop_signals_;
  std::optional<gateway::server::AgentServer> server_;
  std::vector<EventLoop::Watch> watches_;  ///< Watches of the server's descriptors.
  std::optional<Readiness> readiness_;
  int signals_to_end_ = 0;
};

Agentd::Agentd(const AgentdOptions& options)
    : file_(load(options)),
      domain_(options.domain ? *options.domain : gateway::process::default_domain()),
      latch_(latch_for(file_, options)),
      taking_signals_([this] {
        hal::robot::platform::block_signals({SIGUSR1, SIGUSR2});
        loop_.on_signals({SIGTERM, SIGINT}, [this](int) { on_end_signal(); });
        return true;
      }()),
      participant_({.domain = options.inspect_domain.value_or(domain_),
                    .addresses = {address_for_topics(options)},
                    .name = "baraka-agentd " + file_.name}),
      wheels_(hal::robot::agent::make_wheels(file_)),
      infrared_(hal::robot::agent::make_infrared(file_)),
      sensors_(hal::robot::agent::make_sensors(file_)),
      pose_(make_pose_source()),
      link_(open_radio(file_, loop_)),
      inspection_(file_),
      agent_(file_, {loop_, link_, devices(), inspection_}) {
  stop_as_before();
  // Not earlier: both can change the latched state.
  emergency_stop_.emplace(participant_, file_.name,
                          [this](bool stop) { set_emergency_stop(stop, StopSource::kTopic); });
  stop_signals_.emplace({SIGUSR1, SIGUSR2}, [this](int signal) { on_stop_signal(signal); });
  if (file_.program == gateway::server::kTeleop) drive_here();
  server_.emplace(
      gateway::process::join_domain(domain_), agent_,
      gateway::server::ServerSettings{.run = kOnlyRun,
                                      .reply_timeout = {},
                                      .attendance = gateway::server::Attendance::kAnyTime});
  if (wheels_) loop_watch_.emplace(loop_, *wheels_, std::min(file_.command_timeout, kLongestHang));
  if (options.shown) inspection_.start(participant_);
}

hal::robot::agent::Devices Agentd::devices() const {
  hal::robot::agent::Devices devices{wheels_.get(), infrared_.get(), pose_.get()};
  for (const auto& sensor : sensors_) devices.sensors.push_back(sensor.get());
  return devices;
}

void Agentd::stop_as_before() {
  if (!latch_.is_set()) return;
  agent_.set_emergency_stop(true, StopSource::kOperator);
  hal::log::warning(loop_.now(), file_.name,
                    "the emergency stop of an earlier run is in force ({}); SIGUSR2 releases it",
                    latch_.file().string());
}

/// Connects the built-in controller. Before the server asks which agents need a controller, so that
/// none is left.
void Agentd::drive_here() {
  hal::Wants wants;
  if (infrared_) wants.channels.emplace_back("infrared");
  const auto commands =
      std::make_shared<gateway::inspection::TwistReader>(participant_, file_.name);
  agent_.connect(std::make_shared<gateway::server::TeleopPort>(
                     file_.name, [commands] { return commands->last(); }, file_.command_timeout,
                     file_.control_period),
                 {file_.address}, wants);
}

/// Any thread.
void Agentd::set_emergency_stop(bool stop, StopSource source) {
  agent_.set_emergency_stop(stop, source);
  const std::lock_guard lock(latch_mutex_);  // the last thread to come writes the current state
  latch_.set(agent_.is_emergency_stopped());
}

std::unique_ptr<hal::robot::agent::PoseSource> Agentd::make_pose_source() {
  if (const auto* topic =
          std::get_if<hal::robot::agent::PoseTopicSettings>(&file_.localisation.source)) {
    return std::make_unique<TopicPose>(participant_, topic->topic);
  }
  return hal::robot::agent::make_static_pose(file_);
}

int Agentd::run() {
  attend_again();
  if (watchdog_period()) beat();
  readiness_.emplace(
      loop_, file_.name, [this] { return agent_.silent(); }, [this] { print_ready(); });
  loop_.run();
  print_summary();
  return gateway::process::kDone;
}

void Agentd::print_ready() const {
  fmt::print("ready: {} ({}, address {}), radio {}, domain {}\n", file_.name,
             file_.robot ? "robot" : "mote", file_.address.value, link_.own_address(), domain_);
  std::fflush(stdout);
  notify_service_manager("READY=1\nSTATUS=serving");
}

/// Runs on a thread of its own.
void Agentd::on_stop_signal(int signal) {
  if (signal == SIGUSR2) emergency_stop_->release();
  set_emergency_stop(signal == SIGUSR1, StopSource::kOperator);
}

void Agentd::on_end_signal() {
  if (++signals_to_end_ > 1) return loop_.stop();
  stop();
}

/// Stops the wheels first. Then the controller may end.
void Agentd::stop() {
  agent_.stop();
  if (wheels_) {
    if (const auto stopped = wheels_->stop_and_wait(kStopPatience); !stopped) {
      hal::log::warning(loop_.now(), file_.name, "the wheels did not confirm that they stand: {}",
                        stopped.error().message);
    }
  }
  notify_service_manager("STOPPING=1");
  const hal::Time deadline = loop_.now() + kFarewell;
  const auto look = [this, deadline](const auto& again) -> void {
    if (agent_.is_over() || loop_.now() >= deadline) return loop_.stop();
    loop_.schedule(loop_.now() + 5ms, [again] { again(again); });
  };
  look(look);
}

/// The descriptors change with the controllers, so they are watched anew each time.
void Agentd::attend() {
  let_go_of_watches();
  server_->attend(loop_.now());
  for (const int descriptor : server_->descriptors()) {
    if (descriptor >= 0) watches_.push_back(loop_.watch(descriptor, [this] { attend(); }));
  }
}

void Agentd::attend_again() {
  attend();
  loop_.schedule(loop_.now() + kAttendEvery, [this] { attend_again(); });
}

void Agentd::let_go_of_watches() {
  for (const EventLoop::Watch watch : std::exchange(watches_, {})) loop_.unwatch(watch);
}

void Agentd::beat() {
  notify_service_manager("WATCHDOG=1");
  loop_.schedule(loop_.now() + *watchdog_period(), [this] { beat(); });
}

void Agentd::print_summary() const {
  const hal::robot::agent::AgentCounts agent = agent_.counts();
  const hal::robot::radio::LinkCounts& link = link_.counts();
  fmt::print("uptime_s: {:.3f}\ncontrollers: {}\nsteps: {}\nevents: {}\nactions: {}\n",
             hal::to_seconds(loop_.now()), agent.controllers, agent.steps, agent.events,
             agent.actions);
  fmt::print("refused_actions: {}\noverruns: {}\nmissed_cycles: {}\noverflow: {}\n",
             agent.refused_actions, agent.overruns, agent.missed_cycles, agent.overflow);
  fmt::print("latest_cycle_ms: {:.3f}\n", 1e3 * hal::to_seconds(agent.latest_cycle));
  if (const auto* guard = agent_.guard()) {
    const auto& counts = guard->counts();
    fmt::print("commands_limited: {}\nemergency_refused: {}\nblind_refused: {}\nsilences: {}\n",
               counts.limited, counts.stopped, counts.blind, counts.silences);
  }
  if (loop_watch_) fmt::print("hangs: {}\n", loop_watch_->hangs());
  fmt::print("frames_sent: {}\nframes_received: {}\nframes_not_sent: {}\n", link.sent,
             link.received, link.not_sent + link.unknown_neighbour);
  fmt::print("datagrams_malformed: {}\ndatagrams_foreign: {}\nframes_malformed: {}\n",
             link.malformed, link.foreign + link.address_clashes, agent_.malformed_frames());
  for (const std::string& line : gateway::server::complaints(server_->summary())) {
    hal::print_line(hal::Tone::kWarning, "warning: " + line);
  }
}

}  // namespace

int serve(const AgentdOptions& options) { return Agentd(options).run(); }

}  // namespace agentd
