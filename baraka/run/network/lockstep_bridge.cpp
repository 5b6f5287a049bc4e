#include "baraka/run/network/lockstep_bridge.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "baraka/run/network/tap.h"
#include "hal/types/check.h"

namespace baraka::run::network {
namespace {

constexpr std::int64_t kRoomEvery = 10'000'000;  // ns, after the end of a run

std::int64_t nanoseconds(hal::Time time) { return time.time_since_epoch().count(); }

}  // namespace

LockstepBridge::LockstepBridge(std::vector<Station> stations, Programs programs, hal::Clock& wall)
    : programs_(std::move(programs)),
      wall_(wall),
      tcp_(programs_.has_tcp_timer),
      buffer_(kFrameBuffer) {
  std::ranges::sort(stations, {}, &Station::agent);
  all_.reserve(stations.size());
  for (Station& one : stations) all_.push_back(std::make_unique<AgentPrograms>(std::move(one)));
}

const LockstepBridge::AgentPrograms& LockstepBridge::of(hal::AgentId agent) const {
  const auto found =
      std::ranges::lower_bound(all_, agent, {}, [](const auto& one) { return one->station.agent; });
  BARAKA_CHECK(found != all_.end() && (*found)->station.agent == agent);
  return **found;
}

LockstepBridge::AgentPrograms& LockstepBridge::of(hal::AgentId agent) {
  return const_cast<AgentPrograms&>(std::as_const(*this).of(agent));
}

/// The write wakes whoever waits for the frame, so the clock is set before.
void LockstepBridge::on_frame(hal::AgentId agent, hal::Time at,
                              std::span<const std::uint8_t> ethernet) {
  AgentPrograms& one = of(agent);
  one.waits.set_time(nanoseconds(at));
  one.kernel.on_received(ethernet);
  const ssize_t written = ::write(one.station.tap, ethernet.data(), ethernet.size());
  if (written != static_cast<ssize_t>(ethernet.size())) ++not_taken_;
}

void LockstepBridge::on_room(hal::AgentId agent, const Room& room) {
  AgentPrograms& one = of(agent);
  one.station.room->publish_held(one.sent, frame_count(room.free),
                                 std::max<std::uint32_t>(1, frame_count(room.capacity)));
  one.has_woken = one.station.room->has_room(1) && one.waits.wake_for_room();
}

bool LockstepBridge::drain(AgentPrograms& one, std::int64_t now,
                           const std::function<void(std::span<const std::uint8_t>)>& take) {
  one.sent = one.station.room->sent();
  for (bool is_one = false;; is_one = true) {
    const ssize_t length = ::read(one.station.tap, buffer_.data(), buffer_.size());
    if (length < 0 && errno == EINTR) continue;
    if (length < 0 && errno == EAGAIN) return is_one;
    if (length <= 0) {
      throw std::runtime_error(
          fmt::format("the interface of an agent is gone: {}", std::strerror(errno)));
    }
    const auto frame =
        one.kernel.on_sent(std::span(buffer_).first(static_cast<std::size_t>(length)), now);
    if (programs::lockstep::is_tcp(frame)) tcp_.on_segment();
    if (!frame.empty()) take(frame);
  }
}

bool LockstepBridge::run_turns(AgentPrograms& one, std::int64_t now,
                               const std::function<void(std::span<const std::uint8_t>)>& take) {
  one.waits.set_time(now);
  while (one.waits.expire()) {
    if (!one.waits.settle()) return false;
  }
  one.kernel.repeat(now, take);
  // What is taken from the interface makes room in the sockets that it came from.
  bool goes_on = one.waits.settle();
  while (goes_on && drain(one, now, take) && one.waits.waits_to_send())
    goes_on = one.waits.settle();
  one.seen = one.waits.changes();
  return goes_on;
}

bool LockstepBridge::go_on(hal::AgentId agent, hal::Time now,
                           const std::function<void(std::span<const std::uint8_t>)>& take) {
  AgentPrograms& one = of(agent);
  const bool goes_on = run_turns(one, nanoseconds(now), take);
  const std::size_t ended = one.waits.take_ended().size();
  if (ended > 0) programs_.on_ended(agent, now, ended);
  return goes_on;
}

bool LockstepBridge::settle(hal::AgentId agent, hal::Time now) {
  AgentPrograms& one = of(agent);
  one.waits.set_time(nanoseconds(now));
  return one.waits.settle(programs::lockstep::AgentWaits::Turns::kFree);
}

void LockstepBridge::find_changed(const std::function<void(hal::AgentId)>& found) {
  for (const auto& one : all_) {
    if (one->waits.changes() != one->seen) found(one->station.agent);
  }
}

std::optional<hal::Duration> LockstepBridge::hold(hal::Time next) {
  const auto wait = tcp_.hold(next, wall_.now());
  is_held_for_tcp_ = wait.has_value();
  return wait;
}

void LockstepBridge::find_due(const std::function<void(hal::AgentId, hal::Time)>& found) {
  if (!std::exchange(is_held_for_tcp_, false)) return;
  const hal::Time at = tcp_.reached(wall_.now());
  for (const auto& one : all_) {
    pollfd tap{.fd = one->station.tap, .events = POLLIN, .revents = 0};
    if (one->waits.changes() != one->seen || ::poll(&tap, 1, 0) > 0) found(one->station.agent, at);
  }
}

bool LockstepBridge::waits_for_room(hal::AgentId agent) const {
  return of(agent).waits.waits_for_room();
}

std::optional<hal::Time> LockstepBridge::deadline(hal::AgentId agent) const {
  const AgentPrograms& one = of(agent);
  std::optional<std::int64_t> next = one.waits.deadline();
  const auto repeat = one.kernel.next();
  if (repeat) next = std::min(next.value_or(*repeat), *repeat);
  if (!next) return std::nullopt;
  return hal::Time{hal::Duration{*next}};
}

bool LockstepBridge::end_in_turns(AgentPrograms& one, std::int64_t now) {
  // Of a program that sends all the time: as many frames as a radio of some 100 Mb/s would take.
  constexpr std::size_t kFrames = 100;
  if (now >= one.next_room) {
    one.waits.set_time(now);
    on_room(one.station.agent, {.free = kFrames, .capacity = kFrames});
    one.next_room = now + kRoomEvery;
  }
  return run_turns(one, now, [](std::span<const std::uint8_t>) {});
}

/// When something happens to programs after the end.
std::optional<std::int64_t> LockstepBridge::next_of_end(const AgentPrograms& one) {
  const auto deadline = one.waits.deadline();
  if (!one.waits.waits_for_room()) return deadline;
  return std::min(deadline.value_or(one.next_room), one.next_room);
}

void LockstepBridge::end_programs(hal::Time now, hal::Duration grace) {
  const std::int64_t last = nanoseconds(now + grace);
  for (const auto& one : all_) {
    one->waits.begin_to_end();
    bool goes_on = end_in_turns(*one, nanoseconds(now));
    for (const pid_t process : one->waits.processes()) {
      if (!goes_on) break;
      one->waits.send(process, SIGTERM);
      goes_on = end_in_turns(*one, nanoseconds(now));
    }
    auto next = next_of_end(*one);
    for (; goes_on && next && *next <= last; next = next_of_end(*one)) {
      goes_on = end_in_turns(*one, *next);
    }
    for (const pid_t process : one->waits.processes()) {
      if (goes_on) one->waits.send(process, SIGKILL);
    }
  }
}

void LockstepBridge::let_go() {
  for (const auto& one : all_) one->waits.let_go();
}

programs::lockstep::AgentWaits::Counts LockstepBridge::counts() const {
  programs::lockstep::AgentWaits::Counts sum;
  for (const auto& one : all_) {
    const auto& counts = one->waits.counts();
    sum.turns += counts.turns;
    sum.looks += counts.looks;
    sum.expired += counts.expired;
    sum.unknown += counts.unknown;
  }
  return sum;
}

std::uint64_t LockstepBridge::spins() const {
  std::uint64_t sum = 0;
  for (const auto& one : all_) sum += one->waits.spins();
  return sum;
}

}  // namespace baraka::run::network
