#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "baraka/run/network/tcp_pace.h"
#include "hal/types/clock.h"
#include "programs/lockstep/agent_waits.h"
#include "programs/lockstep/kernel_frames.h"
#include "programs/netns/room_page.h"
#include "sim/air/frame_sink.h"
#include "sim/air/held_programs.h"

namespace baraka::run::network {

/// The TAP interfaces and programs of a run in lock-step. On the run's thread.
class LockstepBridge final : public sim::air::FrameSink, public sim::air::HeldPrograms {
 public:
  struct Station {
    hal::AgentId agent;
    int tap = -1;  ///< Non-blocking; each read or write is one frame.
    programs::netns::RoomPage* room = nullptr;
    programs::netns::WaitPage* waits = nullptr;
    programs::lockstep::AgentWaits::Settings settings;
  };
  /// What the run does about programs.
  struct Programs {
    std::function<std::optional<hal::Time>()> next_start;
    std::function<hal::AgentId(hal::Time now)> start_next;
    /// Processes of programs of this agent have ended, as many.
    std::function<void(hal::AgentId agent, hal::Time now, std::size_t count)> on_ended;
    /// Whether TCP of an agent's kernel waits for a timer.
    std::function<bool()> has_tcp_timer;
  };

  /// @param stations  what they point to outlives this.
  /// @param wall  outlives this.
  LockstepBridge(std::vector<Station> stations, Programs programs, hal::Clock& wall);

  void on_frame(hal::AgentId agent, hal::Time at, std::span<const std::uint8_t> ethernet) override;
  void on_room(hal::AgentId agent, const Room& room) override;

  std::optional<hal::Time> next_start() const override { return programs_.next_start(); }
  hal::AgentId start_next(hal::Time now) override { return programs_.start_next(now); }
  bool go_on(hal::AgentId agent, hal::Time now,
             const std::function<void(std::span<const std::uint8_t>)>& take) override;
  /// Lets an agent's programs go on at this time until all wait. Their turns cost nothing: before
  /// the run and at its end simulated time does not pass. What they send is taken in their
  /// next turn. @return false: the run is to be broken off.
  bool settle(hal::AgentId agent, hal::Time now);
  void find_changed(const std::function<void(hal::AgentId)>& found) override;
  void find_due(const std::function<void(hal::AgentId, hal::Time)>& found) override;
  bool waits_for_room(hal::AgentId agent) const override;
  bool has_woken(hal::AgentId agent) const override { return of(agent).has_woken; }
  std::optional<hal::Time> deadline(hal::AgentId agent) const override;

  programs::lockstep::AgentWaits& waits(hal::AgentId agent) { return of(agent).waits; }

  /// Whether the run has to wait before it goes to `next`, for TCP's sake: how long.
  std::optional<hal::Duration> hold(hal::Time next);

  /// The run is over: tells the programs to end, agent by agent and process by process, and lets
  /// them do so in lock-step; what they send goes nowhere. Those that have not ended after `grace`
  /// of virtual time are killed.
  /// @throws std::runtime_error  a program cannot be held.
  void end_programs(hal::Time now, hal::Duration grace);

  /// Programs that are left end as they like.
  void let_go();

  /// Number of received frames that an interface did not accept, because it was shut down.
  std::uint64_t not_taken() const { return not_taken_; }
  /// Of all agents.
  programs::lockstep::AgentWaits::Counts counts() const;
  std::uint64_t spins() const;

 private:
  struct AgentPrograms {
    explicit AgentPrograms(Station&& one)
        : station(std::move(one)), waits(*station.waits, std::move(station.settings)) {}

    Station station;
    programs::lockstep::AgentWaits waits;
    programs::lockstep::KernelFrames kernel;
    std::uint64_t sent = 0;  ///< RoomPage::sent() before the TAP was last seen empty.
    bool has_woken = false;
    std::uint32_t seen = 0;      ///< AgentWaits::changes() after the last turn.
    std::int64_t next_room = 0;  ///< After the end: when its interface takes frames again [ns].
  };

  AgentPrograms& of(hal::AgentId agent);
  const AgentPrograms& of(hal::AgentId agent) const;
  /// The turns of go_on().
  bool run_turns(AgentPrograms& one, std::int64_t now,
                 const std::function<void(std::span<const std::uint8_t>)>& take);
  /// The same after the end. @return false: they are to be let go.
  bool end_in_turns(AgentPrograms& one, std::int64_t now);
  static std::optional<std::int64_t> next_of_end(const AgentPrograms& one);
  /// @return whether there were frames.
  bool drain(AgentPrograms& one, std::int64_t now,
             const std::function<void(std::span<const std::uint8_t>)>& take);

  std::vector<std::unique_ptr<AgentPrograms>> all_;  ///< By address.
  Programs programs_;
  hal::Clock& wall_;
  TcpPace tcp_;
  bool is_held_for_tcp_ = false;
  std::uint64_t not_taken_ = 0;
  std::vector<std::uint8_t> buffer_;
};

}  // namespace baraka::run::network
