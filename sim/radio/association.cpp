#include "sim/radio/association.h"

#include <algorithm>
#include <utility>

namespace sim::radio {

Association::Association(EventQueue& events, hal::AgentId station, const BssConfig& config,
                         const BssParameters& bss, Port& port)
    : events_(events), station_(station), config_(config), bss_(bss), port_(port), heard_(config) {}

void Association::start() { scan(); }

void Association::stop() {
  events_.cancel(timer_);
  events_.cancel(loss_);
  heard_.clear();
  change(State::kOff, std::nullopt);
}

void Association::change(State state, std::optional<hal::AgentId> access_point) {
  state_ = state;
  access_point_ = access_point;
  port_.on_association();
}

void Association::scan() {
  change(State::kScanning, std::nullopt);
  timer_ = events_.schedule(events_.now() + config_.scan_time, Rank::kRadio, station_,
                            [this] { on_scanned(); });
}

void Association::on_scanned() {
  if (const auto strongest = heard_.strongest(events_.now())) return begin(*strongest);
  scan();
}

void Association::begin(hal::AgentId access_point) {
  target_ = access_point;
  change(State::kAuthenticating, access_point_);
  port_.send(FrameType::kAuthentication, target_, encode(Authentication{}));
  wait_for_answer();
}

void Association::wait_for_answer() {
  events_.cancel(timer_);
  timer_ = events_.schedule(events_.now() + config_.answer_timeout, Rank::kRadio, station_,
                            [this] { give_up(); });
}

/// It must be heard again before it is asked again.
void Association::give_up() {
  events_.cancel(timer_);
  heard_.forget(target_);
  if (access_point_) return change(State::kAssociated, access_point_);
  if (const auto other = heard_.strongest(events_.now())) return begin(*other);
  scan();
}

void Association::on_beacon(const Frame& frame, hal::Dbm rssi) {
  if (state_ == State::kOff) return;
  const auto beacon = decode_beacon(*frame.payload);
  if (!beacon || beacon->bss.ssid != bss_.ssid) return;
  heard_.on_beacon(frame.transmitter, rssi, beacon->interval, events_.now());
  if (state_ != State::kAssociated) return;
  if (const auto better = heard_.better_than(*access_point_, events_.now())) begin(*better);
}

void Association::on_management(const Frame& frame) {
  switch (frame.type) {
    case FrameType::kAuthentication:
      return on_authentication(frame);
    case FrameType::kAssociationResponse:
    case FrameType::kReassociationResponse:
      return on_response(frame);
    case FrameType::kDeauthentication:
    case FrameType::kDisassociation:
      return on_dismissal(frame.transmitter);
    default:
      return;  // for access points
  }
}

void Association::on_authentication(const Frame& frame) {
  if (state_ != State::kAuthenticating || frame.transmitter != target_) return;
  const auto answer = decode_authentication(*frame.payload);
  if (!answer || answer->transaction != 2) return;
  if (answer->status != kStatusSuccess) return give_up();
  state_ = State::kAssociating;
  port_.send(access_point_ ? FrameType::kReassociationRequest : FrameType::kAssociationRequest,
             target_,
             encode(AssociationRequest{.bss = bss_, .current_access_point = access_point_}));
  wait_for_answer();
}

void Association::on_response(const Frame& frame) {
  if (state_ != State::kAssociating || frame.transmitter != target_) return;
  const auto answer = decode_association_response(*frame.payload);
  if (!answer) return;
  if (answer->status != kStatusSuccess) return give_up();
  events_.cancel(timer_);
  change(State::kAssociated, target_);
  watch();
}

void Association::on_dismissal(hal::AgentId by) {
  const bool is_asked = state_ == State::kAuthenticating || state_ == State::kAssociating;
  if (is_asked && by == target_) return give_up();
  if (by == access_point_) lose();
}

void Association::on_unanswered(FrameType type, hal::AgentId access_point) {
  const bool is_it = (type == FrameType::kAuthentication && state_ == State::kAuthenticating) ||
                     (type != FrameType::kAuthentication && state_ == State::kAssociating);
  if (is_it && access_point == target_) give_up();
}

void Association::lose() {
  events_.cancel(loss_);
  heard_.forget(*std::exchange(access_point_, std::nullopt));
  if (state_ != State::kAssociated) return port_.on_association();  // it is on its way elsewhere
  if (const auto other = heard_.strongest(events_.now())) return begin(*other);
  scan();
}

/// There is one event, which looks for how long the beacons have stayed away.
void Association::watch() {
  events_.cancel(loss_);
  const hal::Time at = std::max(events_.now(), heard_.lost_at(*access_point_));
  loss_ = events_.schedule(at, Rank::kRadio, station_, [this] {
    if (heard_.lost_at(*access_point_) > events_.now()) return watch();
    lose();
  });
}

}  // namespace sim::radio
