#include "baraka/run/network/tap_bridge.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "baraka/run/network/tap.h"
#include "hal/types/check.h"

namespace baraka::run::network {
namespace {

[[noreturn]] void fail(const char* what) {
  throw std::runtime_error(fmt::format("{}: {}", what, std::strerror(errno)));
}

}  // namespace

TapBridge::TapBridge(const std::vector<Tap>& taps, pace::RealTimeClock& clock)
    : clock_(clock),
      epoll_(::epoll_create1(EPOLL_CLOEXEC)),
      buffer_(kFrameBuffer),
      events_(std::max<std::size_t>(1, taps.size())) {
  if (epoll_ < 0) fail("the agents' interfaces");
  for (const Tap& tap : taps) taps_.push_back({.tap = tap});
  std::ranges::sort(taps_, {}, [](const AgentTap& one) { return one.tap.agent; });
  for (std::size_t i = 0; i < taps_.size(); ++i) {
    epoll_event event{};
    event.events = EPOLLIN;
    event.data.u64 = i;
    if (::epoll_ctl(epoll_, EPOLL_CTL_ADD, taps_[i].tap.descriptor, &event) != 0) {
      fail("an agent's interface");
    }
    taps_[i].empty_at = clock_.wall().now();
  }
}

TapBridge::~TapBridge() {
  if (epoll_ >= 0) ::close(epoll_);
}

TapBridge::AgentTap& TapBridge::of(hal::AgentId agent) {
  const auto found =
      std::ranges::lower_bound(taps_, agent, {}, [](const AgentTap& one) { return one.tap.agent; });
  BARAKA_CHECK(found != taps_.end() && found->tap.agent == agent);
  return *found;
}

void TapBridge::on_frame(hal::AgentId agent, hal::Time, std::span<const std::uint8_t> ethernet) {
  const int tap = of(agent).tap.descriptor;
  const ssize_t written = ::write(tap, ethernet.data(), ethernet.size());
  if (written != static_cast<ssize_t>(ethernet.size())) ++not_taken_;
}

void TapBridge::on_room(hal::AgentId agent, const Room& room) {
  AgentTap& one = of(agent);
  if (one.tap.room == nullptr) return;
  const bool has_changed = !one.is_told || one.sent != one.told_sent || room.free != one.told_room;
  // Includes a program that has only begun to send: it may have been killed since.
  const bool is_one_sending = one.is_one_sending || one.tap.room->is_between(one.sent);
  if (!has_changed && !is_one_sending) return;
  one.is_one_sending = one.tap.room->publish(
      one.sent, frame_count(room.free), std::max<std::uint32_t>(1, frame_count(room.capacity)));
  one.told_sent = one.sent;
  one.told_room = room.free;
  one.is_told = true;
}

bool TapBridge::is_one_sending() const {
  return std::ranges::any_of(taps_, [](const AgentTap& one) { return one.is_one_sending; });
}

void TapBridge::after_wait() {
  wake_up_.after_wait();
  // If something had been there before, the thread would not have slept.
  if (const auto ago = wake_up_.at_most()) nothing_until_ = clock_.wall().now() - *ago;
}

/// Reads the TAPs in turn, so that one that sends continuously cannot block the others.
void TapBridge::read(std::size_t most, const std::function<void(sim::air::SentFrame)>& take) {
  constexpr std::size_t kMostOfOne = 64;
  look();
  while (!ready_.empty() && most > 0) {
    const std::size_t share = std::clamp<std::size_t>(most / ready_.size(), 1, kMostOfOne);
    std::erase_if(ready_, [&](std::size_t i) {
      const std::size_t wanted = std::min(share, most);
      const std::size_t count = read(taps_[i], wanted, take);
      most -= count;
      return count < wanted;
    });
  }
}

/// Finds the TAPs with something to read.
void TapBridge::look() {
  const hal::Time now = clock_.wall().now();
  for (AgentTap& one : taps_) {
    one.sent_before = one.tap.room ? one.tap.room->sent() : 0;
    one.is_ready = false;
  }
  ready_.clear();
  const int count = ::epoll_wait(epoll_, events_.data(), static_cast<int>(events_.size()), 0);
  if (count < 0 && errno != EINTR) fail("the agents' interfaces");
  if (count < 0) return;
  for (const epoll_event& event : std::span(events_).first(static_cast<std::size_t>(count))) {
    taps_[event.data.u64].is_ready = true;
    ready_.push_back(event.data.u64);
  }
  std::ranges::sort(ready_);  // by address, as taps_
  for (AgentTap& one : taps_) {
    if (one.is_ready) continue;
    one.empty_at = now;
    one.sent = one.sent_before;
  }
}

std::size_t TapBridge::read(AgentTap& one, std::size_t most,
                            const std::function<void(sim::air::SentFrame)>& take) {
  const std::uint64_t sent = one.tap.room != nullptr ? one.tap.room->sent() : 0;
  const hal::Time since = clock_.simulated(std::max(one.empty_at, nothing_until_));
  for (std::size_t count = 0; count < most; ++count) {
    const hal::Time now = clock_.wall().now();
    const ssize_t size = ::read(one.tap.descriptor, buffer_.data(), buffer_.size());
    if (size < 0) {
      if (errno == EINTR) continue;
      if (errno != EAGAIN && errno != EWOULDBLOCK) fail("an agent's interface");
      one.empty_at = now;
      one.sent = sent;
      return count;
    }
    take({one.tap.agent, since, {buffer_.begin(), buffer_.begin() + size}});
  }
  return most;
}

}  // namespace baraka::run::network
