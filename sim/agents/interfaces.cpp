#include "sim/agents/interfaces.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "hal/types/check.h"
#include "hal/types/log.h"

namespace sim::agents {
namespace {

/// Largest number of frames read before the run takes them. Further frames stay in the queues of
/// the interfaces.
constexpr std::size_t kMostHeld = 16'384;
/// Frames taken at a time before the run continues.
constexpr std::size_t kMostAtOnce = 1024;

}  // namespace

Interfaces::Interfaces(const SimulationConfig& config, radio::RadioNetwork& radio, const Home& home)
    : home_(home), entering_(config.lateness_limit), leaving_(config.lateness_limit) {
  for (const AgentConfig& agent : config.agents) {
    if (!agent.network) continue;
    interfaces_.push_back(
        {.agent = agent.id,
         .door = air_door(agent.name),
         .interface = std::make_unique<air::Interface>(agent.id, radio.sap(agent.id), *this)});
  }
  for (std::size_t i = 0; i < interfaces_.size(); ++i) {
    interfaces_[i].capacity = interfaces_[i].interface->room();
    home_.outside.open(interfaces_[i].door, [this, i](std::span<const std::uint8_t> ethernet) {
      AgentInterface& one = interfaces_[i];
      one.held -= std::min<std::size_t>(one.held, 1);  // in a repetition there are none
      one.interface->send(ethernet);
    });
  }
}

void Interfaces::connect(air::FrameSink& sink, air::FrameSource& source) {
  sink_ = &sink;
  source_ = &source;
}

void Interfaces::connect(air::FrameSink& sink, air::HeldPrograms& programs) {
  sink_ = &sink;
  programs_ = &programs;
}

Interfaces::AgentInterface& Interfaces::of(hal::AgentId agent) {
  const auto one = std::ranges::lower_bound(interfaces_, agent, {}, &AgentInterface::agent);
  BARAKA_CHECK(one != interfaces_.end() && one->agent == agent);
  return *one;
}

void Interfaces::follow(FollowedClock& clock) {
  clock_ = &clock;
  if (!is_connected()) return;
  const hal::Time start = clock.now();
  source_->read(kMostHeld, [&](air::SentFrame frame) { enter(start, std::move(frame)); });
}

void Interfaces::take_frames(hal::Time last) {
  const std::size_t held = home_.outside.held();
  if (held >= kMostHeld) return;
  hal::Time previous = last + hal::Duration{1};
  source_->read(std::min(kMostAtOnce, kMostHeld - held), [&](air::SentFrame frame) {
    previous = std::max(clock_->now(), previous);
    enter(previous, std::move(frame));
  });
}

/// Nothing counts as late from before the clock started.
void Interfaces::enter(hal::Time at, air::SentFrame&& frame) {
  entering_.add(at - std::max(frame.since, hal::Time{}));
  AgentInterface& one = of(frame.agent);
  ++one.held;
  home_.outside.put_at(at, one.door, std::move(frame.ethernet));
}

void Interfaces::tell_room() {
  for (const AgentInterface& one : interfaces_) tell_room(one);
}

void Interfaces::tell_room(const AgentInterface& one) {
  const std::size_t room = one.interface->room();
  sink_->on_room(one.agent, {.free = room - std::min(room, one.held), .capacity = one.capacity});
}

void Interfaces::on_entered(hal::AgentId agent, const radio::MacRequest& request) {
  home_.observer.on_air_entered(home_.events.now(), agent, request);
}

void Interfaces::on_left(hal::AgentId agent, const radio::MacIndication& indication,
                         std::span<const std::uint8_t> ethernet) {
  const hal::Time at = home_.events.now();
  home_.observer.on_air_left(at, agent, indication);
  if (sink_ == nullptr) return;
  sink_->on_frame(agent, at, ethernet);
  if (programs_ != nullptr) set_turn(of(agent), at);
  if (clock_ != nullptr) leaving_.add(clock_->now() - at);
}

void Interfaces::on_ended(hal::AgentId agent) {
  if (programs_ != nullptr && programs_->waits_for_room(agent))
    set_turn(of(agent), home_.events.now());
}

void Interfaces::on_refused(hal::AgentId agent, air::Refusal refusal, std::size_t bytes) {
  const hal::Time now = home_.events.now();
  ++refused_[static_cast<std::size_t>(refusal)];
  hal::log::debug(now, of(agent).door, "a frame of {} bytes is refused: {}", bytes,
                  air::name(refusal));
  home_.observer.on_air_refused(now, agent, refusal, bytes);
}

void Interfaces::start_programs() {
  if (programs_ == nullptr) return schedule_repeated();
  for (AgentInterface& one : interfaces_) set_turn(one, home_.events.now());
  schedule_start();
}

void Interfaces::schedule_start() {
  const auto at = programs_->next_start();
  if (at) home_.events.schedule(*at, Rank::kProgram, kWorld, [this] { start_due(); });
}

void Interfaces::start_due() {
  const hal::Time now = home_.events.now();
  for (auto at = programs_->next_start(); at && *at <= now; at = programs_->next_start()) {
    set_turn(of(programs_->start_next(now)), now);
  }
  schedule_start();
}

void Interfaces::serve_outsiders(hal::Time next) {
  if (programs_ == nullptr) return;
  programs_->find_changed([&](hal::AgentId agent) { set_turn(of(agent), next); });
}

void Interfaces::serve_due() {
  if (programs_ == nullptr) return;
  programs_->find_due([&](hal::AgentId agent, hal::Time at) {
    set_turn(of(agent), std::max(at, home_.events.now()));
  });
}

/// An earlier turn than the one that is pending takes its place.
void Interfaces::set_turn(AgentInterface& one, hal::Time at) {
  if (home_.events.is_pending(one.turn)) {
    if (one.turn_at <= at) return;
    home_.events.cancel(one.turn);
  }
  const auto i = static_cast<std::size_t>(&one - interfaces_.data());
  one.turn_at = at;
  one.turn = home_.events.schedule(at, Rank::kProgram, one.agent, [this, i] { take_turn(i); });
}

/// What is sent goes into the queue of the station before the programs are told how much room is
/// left, which may let them send more. What became no frame, because the kernel waits for the
/// address of a neighbour, takes no room: without time in between its sender would never wait.
void Interfaces::take_turn(std::size_t i) {
  constexpr hal::Duration kBetweenLost{1'000'000};
  AgentInterface& one = interfaces_[i];
  const hal::Time now = home_.events.now();
  std::size_t frames = 0;
  do {
    frames = 0;
    const bool goes_on = programs_->go_on(one.agent, now, [&](std::span<const std::uint8_t> frame) {
      ++frames;
      arrive(one.door, frame);
    });
    if (!goes_on) return home_.break_off();
    tell_room(one);
  } while (programs_->has_woken(one.agent) && frames > 0);
  auto next = programs_->deadline(one.agent);
  if (programs_->has_woken(one.agent)) {
    const hal::Time again = now + kBetweenLost;
    next = std::min(next.value_or(again), again);
  }
  if (next) set_turn(one, std::max(*next, now + hal::Duration{1}));
}

void Interfaces::arrive(const std::string& door, std::span<const std::uint8_t> bytes) {
  const OutsideArrival arrival{home_.events.now(), door, {bytes.begin(), bytes.end()}};
  home_.observer.on_arrival(arrival);
  home_.outside.hand_over(arrival);
}

void Interfaces::repeat_arrivals(std::vector<OutsideArrival> arrivals) {
  repeated_.assign(std::make_move_iterator(arrivals.begin()),
                   std::make_move_iterator(arrivals.end()));
}

void Interfaces::note_repeated(const std::string& door) {
  const auto noted = std::ranges::find(repeated_, door, &OutsideArrival::door);
  if (noted == repeated_.end()) return;
  const bool was_awaited = noted == repeated_.begin();
  repeated_.erase(noted);
  if (was_awaited) schedule_repeated();
}

/// One after the other, each among the events of its time where the turn was that sent it: after
/// the answer of a controller, which is exchanged between the events, only once that has come.
void Interfaces::schedule_repeated() {
  if (repeated_.empty() || !home_.outside.is_open(repeated_.front().door)) return;
  const hal::Time at = std::max(repeated_.front().at, home_.events.now());
  home_.events.schedule(at, Rank::kProgram, kWorld, [this] {
    const OutsideArrival arrival = std::move(repeated_.front());
    repeated_.pop_front();
    arrive(arrival.door, arrival.bytes);
    schedule_repeated();
  });
}

AirSummary Interfaces::summary() const {
  AirSummary summary{.entering = entering_.summary(), .leaving = leaving_.summary()};
  for (std::size_t i = 0; i < refused_.size(); ++i) {
    if (refused_[i] > 0) {
      summary.refused.emplace_back(air::name(static_cast<air::Refusal>(i)), refused_[i]);
    }
  }
  summary.has_seen_tcp = std::ranges::any_of(
      interfaces_, [](const AgentInterface& one) { return one.interface->has_seen_tcp(); });
  return summary;
}

}  // namespace sim::agents
