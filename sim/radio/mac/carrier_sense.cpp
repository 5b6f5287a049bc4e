#include "sim/radio/mac/carrier_sense.h"

#include <utility>

namespace sim::radio {

CarrierSense::CarrierSense(EventQueue& events, Radio& radio, ChannelAccess& access,
                           const DcfConfig& config, const ModeSet& modes)
    : events_(events),
      radio_(radio),
      access_(access),
      eifs_start_(config.eifs_start),
      modes_(modes),
      timing_(config, modes) {}

void CarrierSense::update() {
  if (is_exchanging_ || radio_.state() != Radio::State::kIdle || nav_.is_set(events_.now())) {
    access_.on_busy();
  } else {
    access_.on_idle();
  }
}

void CarrierSense::on_medium_idle() {
  // EIFS is counted from the end of physical carrier sense, whatever the NAV is (10.3.2.3.7).
  if (std::exchange(last_was_wrong_, false)) access_.hold_until(eifs_from_now());
  update();
}

void CarrierSense::begin_exchange() {
  is_exchanging_ = true;
  update();
}

void CarrierSense::end_exchange(bool is_receiving) {
  is_exchanging_ = false;
  if (!is_receiving) update();
}

void CarrierSense::on_right_frame() {
  last_was_wrong_ = false;
  access_.hold_until(hal::Time::min());
}

void CarrierSense::begin_eifs() {
  if (eifs_start_ == EifsStart::kFrameEnd) {
    access_.hold_until(eifs_from_now());
  } else {
    last_was_wrong_ = true;
  }
}

void CarrierSense::set_nav(const Frame& frame) {
  const hal::Time now = events_.now();
  if (!nav_.extend(now + frame.duration)) return;
  events_.cancel(nav_end_);
  events_.cancel(nav_reset_);
  const hal::AgentId agent = radio_.agent();
  nav_end_ = events_.schedule(nav_.until(), Rank::kRadio, agent, [this] { update(); });
  if (frame.type == FrameType::kRts) {
    const hal::Duration wait = timing_.nav_reset(modes_.response_to(*frame.mode));
    nav_reset_ = events_.schedule(now + wait, Rank::kRadio, agent,
                                  [this, now] { reset_nav_unless_used(now); });
  }
}

/// 10.3.2.4: resets the NAV if no PHY-RXSTART has followed the RTS.
void CarrierSense::reset_nav_unless_used(hal::Time since) {
  if (radio_.has_received_since(since)) return;
  events_.cancel(nav_end_);
  nav_.reset();
  update();
}

void CarrierSense::reset() {
  events_.cancel(nav_end_);
  events_.cancel(nav_reset_);
  nav_.reset();
  is_exchanging_ = false;
  last_was_wrong_ = false;
  access_.reset(radio_.state() != Radio::State::kIdle);
}

}  // namespace sim::radio
