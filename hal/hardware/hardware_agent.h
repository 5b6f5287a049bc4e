#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/exchange/courier.h"
#include "hal/exchange/ports.h"
#include "hal/hardware/agent_observer.h"
#include "hal/hardware/drive_guard.h"
#include "hal/hardware/event_loop.h"
#include "hal/hardware/network_view.h"
#include "hal/hardware/repeated_lines.h"
#include "hal/hardware/robot_file.h"
#include "hal/hardware/sampler.h"
#include "hal/hardware/sensor_watch.h"
#include "hal/hardware/udp_link.h"
#include "hal/routing/router.h"
#include "hal/types/topics.h"

namespace hal::hardware {

/// What an agent did that its controller does not know of, since the start.
struct AgentCounts {
  std::uint64_t controllers = 0;      ///< Processes that drove it, one after the other.
  std::uint64_t steps = 0;            ///< Handed over …
  std::uint64_t events = 0;           ///< … with these.
  std::uint64_t actions = 0;          ///< Taken …
  std::uint64_t refused_actions = 0;  ///< … or refused.
  std::uint64_t overruns = 0;         ///< Control cycles left out: the loop came too late.
  std::uint64_t missed_cycles = 0;    ///< Control cycles left out: the controller was busy.
  std::uint64_t overflow = 0;         ///< Events that found no room while the controller was busy.
  Duration latest_cycle{};            ///< Worst delay of a control cycle.
};

/// A real robot or mote as an AgentHost: what SimulatedAgent is in the simulator, on the wall clock
/// and with real devices and a real network.
///
///   no controller ──connect: START──▶ driven ──stop(): STOP──▶ over
///          ▲                             │
///          └── disconnect; it died ──────┘   wheels stop; radio and routing live on
///
/// Time is that of the loop. An action takes effect when it arrives. One thread, the loop's, except
/// set_emergency_stop().
class HardwareAgent final : public exchange::AgentHost,
                            public routing::Application,
                            public routing::RoutingObserver {
 public:
  struct Surroundings {
    EventLoop& loop;
    UdpLink& link;
    Devices devices;
    AgentObserver& observer;
  };

  /// @param file, surroundings  outlive the agent.
  HardwareAgent(const RobotFile& file, Surroundings surroundings);
  ~HardwareAgent() override;
  HardwareAgent(const HardwareAgent&) = delete;
  HardwareAgent& operator=(const HardwareAgent&) = delete;

  std::vector<exchange::AgentOffer> offers() const override;
  /// @pre the agent has no controller.
  void connect(std::shared_ptr<exchange::ControllerPort> port, const std::vector<AgentId>& agents,
               const Wants& wants) override;
  /// The agent's controller is gone; without one: no effect.
  void disconnect(const std::vector<AgentId>& agents) override;

  bool has_controller() const { return courier_.has_value(); }

  /// Devices, and the network, that give nothing now; empty: the agent is all there.
  std::vector<SilentDevice> silent() const;

  /// Latched until it is released. Any thread.
  void set_emergency_stop(bool stop, StopSource source);
  bool is_emergency_stopped() const { return guard_ && guard_->is_emergency_stopped(); }

  /// The wheels stop, then the controller gets its STOP. From now on it can do no more than talk.
  void stop();
  /// After stop(): the controller has answered, or is gone.
  bool is_over() const { return !courier_; }

  AgentCounts counts() const;
  const DriveGuard* guard() const { return guard_ ? &*guard_ : nullptr; }
  std::uint64_t malformed_frames() const { return router_.malformed_frames(); }

  void on_message(Message message) override;
  void on_fate(MessageId id, Fate fate) override;
  void on_route_change(const RouteChange& change) override;
  void on_neighbour(const Neighbour& neighbour) override;
  void on_neighbour_lost(AgentId neighbour) override;

 private:
  void schedule_cycle(Time at);
  void on_cycle(Time due);
  void look_at_sensors();
  void observe();

  exchange::Event event(exchange::Cause cause);
  void post(exchange::Event event);
  void attend_soon();
  void attend();
  void take_in(const exchange::Courier::Turn& turn);
  void apply(const exchange::Action& action);
  void refuse(const std::string& why);
  Result<void> take_effect(const exchange::Action& action);
  Result<void> drive(const exchange::Action& action);
  Result<void> send(const exchange::Action& action);
  void set_timer(const exchange::Action& action);
  void end_with_error(const std::string& text);
  void let_go();

  const RobotFile& file_;
  Surroundings surroundings_;
  EventLoop& loop_;
  std::optional<DriveGuard> guard_;  ///< None without wheels.
  Sampler sampler_;
  SensorWatch sensor_watch_;
  NetworkView network_;
  routing::Router router_;
  std::optional<exchange::Courier> courier_;  ///< None without a controller.
  std::vector<EventLoop::Watch> watches_;     ///< Of the courier's descriptors.
  EventLoop::Handle cycle_ = 0, attending_ = 0;
  std::map<TimerId, EventLoop::Handle> controller_timers_;
  /// A controller numbers its messages from 1, as the one before it did; for the network they are
  /// numbered on. By the network's number.
  std::map<MessageId, MessageId> sent_;
  Topics topics_;  ///< That the controller named.
  MessageId last_message_ = 0;
  bool stopping_ = false;
  Time answered_at_{};  ///< When the answers came in that take effect now.
  RepeatedLines refusals_;
  AgentCounts counts_;
};

/// The mistake in a message that a controller wants to send; empty: none.
std::string mistake_in_message(const exchange::Action& action, AgentId self);

}  // namespace hal::hardware
