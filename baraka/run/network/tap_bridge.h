#pragma once

#include <sys/epoll.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "baraka/run/pace/real_time_clock.h"
#include "baraka/run/pace/wake_up_latency.h"
#include "programs/netns/room_page.h"
#include "sim/air/frame_sink.h"
#include "sim/air/frame_source.h"

namespace baraka::run::network {

/// The TAP interfaces of a run: writes frames received by radio to them, reads frames of programs
/// from them, and tells programs how much room the stations' queues have.
///
/// Gives an upper bound of how long a frame has waited to be read: the time since its TAP was last
/// seen empty or, if the run slept after that, since the run was woken. On the run's thread.
class TapBridge final : public sim::air::FrameSink, public sim::air::FrameSource {
 public:
  struct Tap {
    hal::AgentId agent;
    int descriptor = -1;  ///< Non-blocking; each read or write is one frame.
    programs::netns::RoomPage* room = nullptr;
  };

  /// @param taps, clock  must outlive this object.
  /// @throws std::runtime_error  no epoll descriptor is available.
  TapBridge(const std::vector<Tap>& taps, pace::RealTimeClock& clock);
  ~TapBridge() override;

  void on_frame(hal::AgentId agent, hal::Time at, std::span<const std::uint8_t> ethernet) override;
  void on_room(hal::AgentId agent, const Room& room) override;

  int descriptor() const override { return epoll_; }
  void read(std::size_t most, const std::function<void(sim::air::SentFrame)>& take) override;

  /// To be called directly before and after the run waits.
  void before_wait() { wake_up_.before_wait(); }
  void after_wait();

  /// Whether a program is in the middle of sending, so that reading again soon is worthwhile.
  bool is_one_sending() const;

  /// Number of received frames that an interface did not accept, because it was shut down.
  std::uint64_t not_taken() const { return not_taken_; }

 private:
  struct AgentTap {
    Tap tap;
    hal::Time empty_at{};           ///< Wall time at which the TAP was last seen empty.
    std::uint64_t sent = 0;         ///< RoomPage::sent() before it was seen empty.
    std::uint64_t sent_before = 0;  ///< RoomPage::sent() directly before the last look.
    std::uint64_t told_sent = 0;
    std::size_t told_room = 0;
    bool is_ready = false;
    bool is_told = false;
    bool is_one_sending = false;
  };

  AgentTap& of(hal::AgentId agent);
  void look();
  std::size_t read(AgentTap& one, std::size_t most,
                   const std::function<void(sim::air::SentFrame)>& take);

  std::vector<AgentTap> taps_;  ///< Sorted by address.
  pace::RealTimeClock& clock_;
  pace::WakeUpLatency wake_up_;
  hal::Time nothing_until_{};  ///< Wall time until which no TAP had received anything.
  int epoll_;
  std::uint64_t not_taken_ = 0;
  std::vector<std::uint8_t> buffer_;
  std::vector<epoll_event> events_;  ///< One for each TAP.
  std::vector<std::size_t> ready_;   ///< Indices of TAPs with something to read.
};

}  // namespace baraka::run::network
