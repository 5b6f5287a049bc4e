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

/// The TAPs of a run: what comes off the air is written to them, what programs send is read from
/// them, and programs are told of the room in the stations' queues.
///
/// How long a frame may have waited for its reading is known by its upper bound: since the TAP was
/// last seen empty or, if the run slept after that, since it was woken. On the run's thread.
class TapBridge final : public sim::air::FrameSink, public sim::air::FrameSource {
 public:
  struct Tap {
    hal::AgentId agent;
    int descriptor = -1;  ///< Non-blocking; a frame for each read and write.
    programs::netns::RoomPage* room = nullptr;
  };

  /// @param taps  outlive it, as the clock does. @throws std::runtime_error  no epoll descriptor.
  TapBridge(const std::vector<Tap>& taps, pace::RealTimeClock& clock);
  ~TapBridge() override;

  void on_frame(hal::AgentId agent, hal::Time at, std::span<const std::uint8_t> ethernet) override;
  void on_room(hal::AgentId agent, const Room& room) override;

  int descriptor() const override { return epoll_; }
  void read(std::size_t most, const std::function<void(sim::air::SentFrame)>& take) override;

  /// Right before and after the run waits.
  void before_wait() { wake_up_.before_wait(); }
  void after_wait();

  /// Whether a program is between two steps of sending: look again soon.
  bool is_one_sending() const;

  /// Frames off the air that an interface did not take: a program has shut it down.
  std::uint64_t not_taken() const { return not_taken_; }

 private:
  struct AgentTap {
    Tap tap;
    hal::Time empty_at{};           ///< Wall time at which it was seen empty.
    std::uint64_t sent = 0;         ///< Of the page, before it was seen empty.
    std::uint64_t sent_before = 0;  ///< Of the page, when it was about to be looked at.
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

  std::vector<AgentTap> taps_;  ///< By address.
  pace::RealTimeClock& clock_;
  pace::WakeUpLatency wake_up_;
  hal::Time nothing_until_{};  ///< Wall time until which nothing had come to any TAP.
  int epoll_;
  std::uint64_t not_taken_ = 0;
  std::vector<std::uint8_t> buffer_;
  std::vector<epoll_event> events_;  ///< One for each port.
  std::vector<std::size_t> ready_;   ///< Indices of ports with something to read.
};

}  // namespace baraka::run::network
