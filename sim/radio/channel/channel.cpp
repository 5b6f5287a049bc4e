#include "sim/radio/channel/channel.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "sim/radio/phy/radio.h"

namespace sim::radio {
namespace {

/// So many are always in the cache.
constexpr std::size_t kFewRadios = 64;
constexpr StationIndex kNoStation = std::numeric_limits<StationIndex>::max();

}  // namespace

Channel::Channel(EventQueue& events, Neighbourhood& neighbourhood, RadioObserver& observer,
                 const WavesConfig& config)
    : events_(events),
      neighbourhood_(neighbourhood),
      observer_(observer),
      delays_(config.propagation.propagation_delay),
      preamble_window_(config.receiver.preamble_window),
      faint_frames_(neighbourhood) {}

Channel::~Channel() = default;

void Channel::add(Radio& radio) {
  radios_.push_back(&radio);
  faint_frames_.add_receiver();
  faint_.emplace_back(faint_frames_, radio.index(), radio.energy_detection());
  current_.emplace_back();
}

void Channel::transmit(Radio& from, const PpduPtr& ppdu) {
  for (const auto& part : ppdu->parts) observer_.on_frame_start(events_.now(), *part.frame);
  Transmission& transmission = transmissions_.claim();
  transmission.ppdu = ppdu;
  transmission.from = &from;
  transmission.start = events_.now();
  transmission.after_arrival = {hal::Duration{}, preamble_window_, ppdu->airtime};
  const Links& links = neighbourhood_.links_from(from.index());
  transmission.receivers.reserve(links.audible.size());
  for (const std::uint32_t one : links.by_arrival) {
    const AudibleLink& link = links.audible[one];
    transmission.receivers.push_back(
        {.radio = radios_[link.receiver], .index = link.receiver, .arrival = link.arrival});
  }
  current_[from.index()] = &transmission;
  transmissions_.add_use(transmission);
  start_faint(*ppdu, from.index(), links);
  if (delays_) {
    start_one_by_one(transmission);
  } else {
    start_everywhere(transmission);
  }
  transmission.end = events_.schedule(events_.now() + ppdu->airtime, Rank::kRadio, from.agent(),
                                      [this, &transmission] { finish(transmission); });
}

void Channel::start_faint(const Ppdu& ppdu, StationIndex from, const Links& links) {
  const auto& asked = links.asked.all();
  const std::size_t receivers = links.faint.size() + asked.size();
  if (receivers == 0) return;
  for (const auto& part : ppdu.parts) {
    observer_.on_faint(*part.frame, static_cast<std::uint32_t>(receivers));
  }
  if (!asked.empty()) faint_frames_.start(from, events_.now(), ppdu.airtime);
  if (links.faint.empty()) {
    return faint_frames_.raise(asked, [this](StationIndex to) { start_asked(to); });
  }
  if (asked.empty()) return add_faint(ppdu, from, links.faint);
  // In order of receivers, as if they were one list.
  auto next = asked.begin();
  const auto start_before = [&](StationIndex receiver) {
    const auto last = std::find_if(next, asked.end(),
                                   [=](const auto& link) { return link.receiver >= receiver; });
    faint_frames_.raise({next, last}, [this](StationIndex to) { start_asked(to); });
    next = last;
  };
  for (std::size_t i = 0; i < links.faint.size(); ++i) {
    start_before(links.faint[i].receiver);
    add_faint(ppdu, from, {links.faint.data() + i, 1});
  }
  start_before(kNoStation);
}

/// A frame begins at a receiver that needs to know.
void Channel::start_asked(StationIndex receiver) {
  if (faint_[receiver].start(events_.now())) radios_[receiver]->watch_energy();
}

void Channel::add_faint(const Ppdu& ppdu, StationIndex from, std::span<const FaintLink> links) {
  const hal::Time now = events_.now();
  const std::size_t count = links.size();
  // Of those ahead first the FaintSignals are fetched, later the memory to which they point.
  constexpr std::size_t kFirst = 32, kSecond = 16;
  const std::size_t some = std::min(count, kFirst);
  for (std::size_t i = 0; i < some; ++i) __builtin_prefetch(&faint_[links[i].receiver], 1);
  for (std::size_t i = 0; i < count; ++i) {
    if (i + kFirst < count) __builtin_prefetch(&faint_[links[i + kFirst].receiver], 1);
    if (i + kSecond < count) faint_[links[i + kSecond].receiver].prefetch();
    const FaintLink& link = links[i];
    const bool alarms =
        faint_[link.receiver].add(from, now, hal::Duration{link.delay}, ppdu.airtime, link.power);
    if (alarms) radios_[link.receiver]->watch_energy();
  }
}

void Channel::start_everywhere(Transmission& transmission) {
  bool window_opened = false;
  for (const auto& receiver : transmission.receivers) {
    window_opened |= receiver.radio->begin_signal(*transmission.ppdu, receiver.arrival);
  }
  if (!window_opened) return;
  transmissions_.add_use(transmission);
  events_.schedule(events_.now() + preamble_window_, Rank::kRadio, transmission.from->agent(),
                   [this, &transmission] {
                     for (const auto& receiver : transmission.receivers) {
                       receiver.radio->close_preamble_window();
                     }
                     transmissions_.drop_use(transmission);
                   });
}

EventQueue::Place Channel::place_for(const Radio& radio) {
  return events_.reserve(Rank::kRadio, radio.agent());
}

void Channel::start_one_by_one(Transmission& transmission) {
  for (auto& receiver : transmission.receivers) {
    receiver.places[static_cast<std::size_t>(Phase::kArrival)] = place_for(*receiver.radio);
  }
  if (transmission.receivers.empty()) return;
  transmissions_.add_use(transmission);
  schedule(transmission, Phase::kArrival);
}

/// Reserves the place of a receiver's event in this phase. @pre receivers are passed in order of
/// time.
void Channel::follow(Transmission& transmission, Phase phase, std::size_t index) {
  auto& receiver = transmission.receivers[index];
  receiver.places[static_cast<std::size_t>(phase)] = place_for(*receiver.radio);
  auto& series = transmission.series[static_cast<std::size_t>(phase)];
  if (series.is_pending) return;
  series.next = index;
  transmissions_.add_use(transmission);
  schedule(transmission, phase);
}

void Channel::schedule(Transmission& transmission, Phase phase) {
  auto& series = transmission.series[static_cast<std::size_t>(phase)];
  const auto& receiver = transmission.receivers[series.next];
  series.is_pending = true;
  events_.schedule(transmission.due(phase, receiver),
                   receiver.places[static_cast<std::size_t>(phase)],
                   [this, &transmission, phase] { work_off(transmission, phase); });
}

void Channel::work_off(Transmission& transmission, Phase phase) {
  const auto p = static_cast<std::size_t>(phase);
  auto& series = transmission.series[p];
  const auto& receivers = transmission.receivers;
  if (radios_.size() > kFewRadios) prefetch_first(receivers, series.next);
  do {
    prefetch(receivers, series.next);
    act(transmission, phase, series.next);
    do {
      ++series.next;
    } while (series.next < receivers.size() && receivers[series.next].places[p].order == 0);
    if (series.next == receivers.size()) {
      series.is_pending = false;
      return transmissions_.drop_use(transmission);
    }
  } while (events_.go_on(transmission.due(phase, receivers[series.next]),
                         receivers[series.next].places[p]));
  schedule(transmission, phase);
}

/// Prefetches what the first of a series would wait for, one line after the other.
void Channel::prefetch_first(const std::vector<Transmission::Receiver>& receivers,
                             std::size_t first) const {
  receivers[first].radio->prefetch();
  __builtin_prefetch(&faint_[receivers[first].index]);
  if (first + 1 < receivers.size()) {
    receivers[first + 1].radio->prefetch();
    __builtin_prefetch(&faint_[receivers[first + 1].index]);
  }
  receivers[first].radio->prefetch_listener();
}

/// Prefetches for the receivers ahead: first the radio, then the memory to which it points.
void Channel::prefetch(const std::vector<Transmission::Receiver>& receivers,
                       std::size_t now) const {
  if (radios_.size() <= kFewRadios) return;
  if (now + 2 < receivers.size()) {
    receivers[now + 2].radio->prefetch();
    __builtin_prefetch(&faint_[receivers[now + 2].index]);
  }
  if (now + 1 < receivers.size()) {
    receivers[now + 1].radio->prefetch_listener();
    faint_[receivers[now + 1].index].prefetch_all();
  }
}

void Channel::act(Transmission& transmission, Phase phase, std::size_t receiver) {
  Radio& radio = *transmission.receivers[receiver].radio;
  switch (phase) {
    case Phase::kArrival:
      return arrive(transmission, receiver);
    case Phase::kWindow:
      return radio.close_preamble_window();
    case Phase::kEnd:
      return radio.end_signal(*transmission.ppdu, false);
  }
}

void Channel::arrive(Transmission& transmission, std::size_t index) {
  const auto& receiver = transmission.receivers[index];
  const bool window_opened = receiver.radio->begin_signal(*transmission.ppdu, receiver.arrival);
  if (window_opened) follow(transmission, Phase::kWindow, index);
  follow(transmission, Phase::kEnd, index);
}

void Channel::finish(Transmission& transmission) {
  Transmission*& current = current_[transmission.from->index()];
  if (current == &transmission) current = nullptr;
  transmission.from->end_transmit(*transmission.ppdu);
  if (!delays_) {
    for (const auto& receiver : transmission.receivers) {
      receiver.radio->end_signal(*transmission.ppdu, false);
    }
  }
  transmissions_.drop_use(transmission);
}

void Channel::interfere(StationIndex at, hal::Duration delay, hal::Duration length, double power) {
  const bool alarms = faint_[at].add(kNoStation, events_.now(), delay, length, power);
  if (alarms) radios_[at]->watch_energy();
}

void Channel::cut(const Radio& from) {
  Transmission* const transmission = std::exchange(current_[from.index()], nullptr);
  if (transmission == nullptr) return;
  events_.cancel(transmission->end);
  for (const auto& part : transmission->ppdu->parts) {
    observer_.on_frame_cut(events_.now(), *part.frame);
  }
  faint_frames_.cut(from.index(), transmission->start, events_.now());
  for (FaintSignals& faint : faint_) {
    faint.cut(from.index(), transmission->start, events_.now());
  }
  for (const auto& receiver : transmission->receivers) {
    Radio& radio = *receiver.radio;
    if (!delays_) {
      radio.end_signal(*transmission->ppdu, true);
      continue;
    }
    transmissions_.add_use(*transmission);
    events_.schedule(events_.now() + receiver.arrival.delay, Rank::kRadio, radio.agent(),
                     [this, &radio, transmission] {
                       radio.end_signal(*transmission->ppdu, true);
                       transmissions_.drop_use(*transmission);
                     });
  }
  transmissions_.drop_use(*transmission);
}

}  // namespace sim::radio
