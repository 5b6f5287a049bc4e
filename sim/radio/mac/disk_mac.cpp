#include "sim/radio/mac/disk_mac.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace sim::radio {

DiskMac::DiskMac(const Context& context, std::optional<std::uint32_t> queue_limit, DiskAir& air)
    : MacBase(context),
      air_(air),
      queue_limit_(queue_limit),
      frames_(context.lengths, context.modes, context.agent),
      index_(static_cast<StationIndex>(air.stations.size())),
      state_(context.events, State::kIdle) {
  air_.stations.push_back(this);
}

void DiskMac::transmit(const MacRequest& request) {
  check(request);
  if (!radio_on()) return report_later(request, hal::Verdict::kRadioOff);
  if (queue_limit_ && queue_.size() >= *queue_limit_) {
    return report_later(request, hal::Verdict::kQueueFull);
  }
  queue_.push_back(request);
  if (!sending_) start_head();
}

std::size_t DiskMac::room() const {
  if (!queue_limit_) return std::numeric_limits<std::size_t>::max();
  return *queue_limit_ - std::min<std::size_t>(*queue_limit_, queue_.size());
}

void DiskMac::start_head() {
  state_ = State::kTransmit;
  sending_ = frames_.data(queue_.front(),
                          {.sequence = static_cast<std::uint16_t>(next_sequence_++ % 4096)});
  observer().on_frame_start(now(), *sending_);
  receivers_.clear();
  for (const AudibleLink& link : air_.neighbourhood.links_from(index_).audible) {
    receivers_.push_back(link.receiver);
  }
  end_ = events().schedule(now() + sending_->airtime, Rank::kRadio, agent(),
                           [this] { finish_head(); });
}

void DiskMac::finish_head() {
  const bool delivered = end_at_receivers(false);
  if (!sending_) return;  // a receiver's client switched this radio off
  learn_service_time(sending_->airtime);
  sending_.reset();
  state_ = State::kIdle;
  const MacRequest done = std::move(queue_.front());
  queue_.pop_front();
  if (!queue_.empty()) start_head();
  report(done, delivered ? hal::Verdict::kDelivered : hal::Verdict::kRetryLimit);
}

bool DiskMac::end_at_receivers(bool cut) {
  const FramePtr frame = sending_;
  bool delivered = frame->is_broadcast();
  for (const StationIndex receiver : std::exchange(receivers_, {})) {
    DiskMac& station = *air_.stations[receiver];
    const bool received = station.radio_on() && !cut;
    observer().on_reception(now(), *frame, station.agent(),
                            received ? hal::Verdict::kDelivered : hal::Verdict::kRadioOff,
                            hal::Dbm{}.value);
    if (!received) continue;
    delivered |= station.agent() == frame->receiver;
    station.receive(*frame);
  }
  return delivered;
}

void DiskMac::receive(const Frame& frame) {
  if (frame.is_broadcast() || frame.receiver == agent()) hand_up(frame, {}, {});
}

void DiskMac::set_radio(bool on) {
  if (on == radio_on()) return;
  state_ = on ? State::kIdle : State::kOff;
  if (on) return;
  if (sending_) {
    events().cancel(end_);
    observer().on_frame_cut(now(), *sending_);
    end_at_receivers(true);
    sending_.reset();
  }
  for (MacRequest& request : std::exchange(queue_, {})) {
    report_later(std::move(request), hal::Verdict::kRadioOff);
  }
}

}  // namespace sim::radio
