#include "sim/radio/channel.h"

#include <utility>

#include "sim/radio/radio.h"

namespace sim::radio {

struct Channel::Transmission {
  struct Receiver {
    Radio* radio;
    Propagation::Arrival arrival;
  };

  FramePtr frame;
  Radio* from = nullptr;
  hal::Time start{};
  std::vector<Receiver> receivers;
  EventQueue::EventId end;
};

Channel::Channel(EventQueue& events, Neighbourhood& neighbourhood, RadioObserver& observer,
                 const WavesConfig& config)
    : events_(events),
      neighbourhood_(neighbourhood),
      observer_(observer),
      delays_(config.propagation.propagation_delay),
      preamble_window_(config.receiver.preamble_window) {}

Channel::~Channel() = default;

void Channel::add(Radio& radio) {
  radios_.push_back(&radio);
  faint_.emplace_back(radio.energy_detection());
  current_.emplace_back();
}

void Channel::transmit(Radio& from, const FramePtr& frame) {
  observer_.on_frame_start(events_.now(), *frame);
  const auto transmission = std::make_shared<Transmission>();
  transmission->frame = frame;
  transmission->from = &from;
  transmission->start = events_.now();
  const Links& links = neighbourhood_.links_from(from.index());
  transmission->receivers.reserve(links.audible.size());
  for (const AudibleLink& link : links.audible) {
    transmission->receivers.push_back({radios_[link.receiver], link.arrival});
  }
  current_[from.index()] = transmission;
  start_faint(*frame, from.index(), links.faint);
  if (delays_) {
    start_one_by_one(transmission);
  } else {
    start_everywhere(transmission);
  }
  transmission->end = events_.schedule(events_.now() + frame->airtime, Rank::kRadio, from.agent(),
                                       [this, transmission] { finish(transmission); });
}

void Channel::start_faint(const Frame& frame, StationIndex from,
                          const std::vector<FaintLink>& links) {
  if (links.empty()) return;
  observer_.on_faint(frame, static_cast<std::uint32_t>(links.size()));
  const hal::Time now = events_.now();
  for (const FaintLink& link : links) {
    const bool alarms =
        faint_[link.receiver].add(from, now, hal::Duration{link.delay}, frame.airtime, link.power);
    if (alarms) radios_[link.receiver]->watch_energy();
  }
}

void Channel::start_everywhere(const TransmissionPtr& transmission) {
  bool window_opened = false;
  for (const auto& receiver : transmission->receivers) {
    window_opened |= receiver.radio->begin_signal(transmission->frame, receiver.arrival);
  }
  if (!window_opened) return;
  events_.schedule(events_.now() + preamble_window_, Rank::kRadio, transmission->from->agent(),
                   [transmission] {
                     for (const auto& receiver : transmission->receivers) {
                       receiver.radio->close_preamble_window();
                     }
                   });
}

void Channel::start_one_by_one(const TransmissionPtr& transmission) {
  for (std::size_t i = 0; i < transmission->receivers.size(); ++i) {
    const auto& receiver = transmission->receivers[i];
    events_.schedule(events_.now() + receiver.arrival.delay, Rank::kRadio, receiver.radio->agent(),
                     [this, transmission, i] { arrive(transmission, i); });
  }
}

void Channel::arrive(const TransmissionPtr& transmission, std::size_t receiver) {
  Radio& radio = *transmission->receivers[receiver].radio;
  const FramePtr& frame = transmission->frame;
  if (radio.begin_signal(frame, transmission->receivers[receiver].arrival)) {
    events_.schedule(events_.now() + preamble_window_, Rank::kRadio, radio.agent(),
                     [&radio] { radio.close_preamble_window(); });
  }
  events_.schedule(events_.now() + frame->airtime, Rank::kRadio, radio.agent(),
                   [&radio, frame] { radio.end_signal(*frame, false); });
}

void Channel::finish(const TransmissionPtr& transmission) {
  TransmissionPtr& current = current_[transmission->from->index()];
  if (current == transmission) current.reset();
  transmission->from->end_transmit(*transmission->frame);
  if (delays_) return;
  for (const auto& receiver : transmission->receivers) {
    receiver.radio->end_signal(*transmission->frame, false);
  }
}

void Channel::cut(const Radio& from) {
  const TransmissionPtr transmission = std::exchange(current_[from.index()], nullptr);
  if (!transmission) return;
  events_.cancel(transmission->end);
  observer_.on_frame_cut(events_.now(), *transmission->frame);
  for (FaintSignals& faint : faint_) {
    faint.cut(from.index(), transmission->start, events_.now());
  }
  for (const auto& receiver : transmission->receivers) {
    Radio& radio = *receiver.radio;
    if (!delays_) {
      radio.end_signal(*transmission->frame, true);
      continue;
    }
    events_.schedule(events_.now() + receiver.arrival.delay, Rank::kRadio, radio.agent(),
                     [&radio, transmission] { radio.end_signal(*transmission->frame, true); });
  }
}

}  // namespace sim::radio
