#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hal/node/agent/agent_core.h"
#include "hal/node/exchange/courier.h"
#include "hal/node/exchange/ports.h"
#include "hal/robot/agent/drive_guard.h"
#include "hal/robot/agent/robot_file.h"
#include "hal/robot/agent/sampler.h"
#include "hal/robot/agent/sensor_watch.h"
#include "hal/robot/platform/event_loop.h"
#include "hal/robot/radio/udp_link.h"

namespace hal::robot::agent {

/// Counts, since the start, of events in an agent that its controller cannot see.
struct AgentCounts {
  std::uint64_t controllers = 0;      ///< Successive processes that drove it.
  std::uint64_t steps = 0;            ///< Handed over to controllers.
  std::uint64_t events = 0;           ///< In these steps.
  std::uint64_t actions = 0;          ///< Actions accepted.
  std::uint64_t refused_actions = 0;  ///< Actions refused.
  std::uint64_t overruns = 0;         ///< Control cycles skipped because the loop was late.
  std::uint64_t missed_cycles = 0;    ///< Control cycles skipped because the controller was busy.
  /// Events lost because the queue was full while the controller was busy.
  std::uint64_t overflow = 0;
  Duration latest_cycle{};  ///< Largest delay of a control cycle.
};

/// A real robot or mote as an AgentHost. It connects an AgentCore to the event loop, a UDP link and
/// the drivers of real devices.
///
///   no controller ──connect: START──▶ driven ──stop(): STOP──▶ over
///          ▲                             │
///          └── disconnect; it died ──────┘   wheels stop; radio and routing continue
///
/// Times are those of the loop. An action takes effect when it arrives. Only the loop's thread,
/// except for set_emergency_stop().
class HardwareAgent final : public node::exchange::AgentHost, private node::agent::AgentListener {
 public:
  struct Surroundings {
    platform::EventLoop& loop;
    radio::UdpLink& link;
    Devices devices;
    node::agent::AgentObserver& observer;
  };

  /// @param file, surroundings  outlive the agent.
  HardwareAgent(const RobotFile& file, Surroundings surroundings);
  ~HardwareAgent() override;
  HardwareAgent(const HardwareAgent&) = delete;
  HardwareAgent& operator=(const HardwareAgent&) = delete;

  std::vector<node::exchange::AgentOffer> offers() const override;
  /// This agent and those on the map of its file.
  std::vector<node::exchange::AgentName> directory() const override;
  /// @pre the agent has no controller.
  void connect(std::shared_ptr<node::exchange::ControllerPort> port,
               const std::vector<AgentId>& agents, const Wants& wants) override;
  /// The agent's controller is gone. No effect if it has none.
  void disconnect(const std::vector<AgentId>& agents) override;

  bool has_controller() const { return courier_.has_value(); }

  /// Devices, and the network, that deliver nothing now; empty: all work.
  std::vector<SilentDevice> silent() const;

  /// Latched until it is released. Any thread.
  void set_emergency_stop(bool stop, StopSource source);
  bool is_emergency_stopped() const { return guard_ && guard_->is_emergency_stopped(); }

  /// Stops the wheels, then sends STOP to the controller, whose later actions take effect only if
  /// exchange::is_word() holds.
  void stop();
  /// After stop(): whether the controller has answered, or is gone.
  bool is_over() const { return !courier_; }

  AgentCounts counts() const;
  const DriveGuard* guard() const { return guard_ ? &*guard_ : nullptr; }
  node::agent::AgentCore& core() { return core_; }
  std::uint64_t malformed_frames() const { return core_.router().malformed_frames(); }

 private:
  void on_inbox(AgentId agent) override;
  void on_state(AgentId agent, const std::string& state) override;

  void schedule_cycle(Time at);
  void on_cycle(Time due);
  void look_at_sensors();

  void attend_soon();
  void attend();
  void take_in(const node::exchange::Courier::Turn& turn);
  void take_effect(const node::exchange::Action& action, bool stale);
  void end_with_error(const std::string& text);
  void let_go();

  const RobotFile& file_;
  Surroundings surroundings_;
  platform::EventLoop& loop_;
  std::optional<DriveGuard> guard_;  ///< nullopt without wheels.
  Sampler sampler_;
  SensorWatch sensor_watch_;
  node::agent::AgentCore core_;
  std::optional<node::exchange::Courier> courier_;   ///< nullopt without a controller.
  std::vector<platform::EventLoop::Watch> watches_;  ///< On the courier's descriptors.
  platform::EventLoop::Handle cycle_ = 0, attending_ = 0;
  bool stopping_ = false;
  Time answered_at_{};  ///< Arrival of the answers that take effect now.
  AgentCounts counts_;
};

}  // namespace hal::robot::agent
