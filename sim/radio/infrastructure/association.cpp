#include "sim/radio/infrastructure/association.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace sim::radio {
namespace {

/// mac80211 stays on a channel for 1/33 s after a probe request, so stations that scan reach the
/// access point's channel in steps of this length.
constexpr hal::Duration kFirstSpread{30'000'000};
/// wpa_supplicant waits for 100 ms after the first failed attempt, and longer after each further
/// one, up to 10 s.
constexpr hal::Duration kSpreadAfterFailure{100'000'000};
constexpr hal::Duration kLongestSpread{10'000'000'000};

}  // namespace

Association::Association(EventQueue& events, Station station, const BssConfig& config,
                         Client& client)
    : events_(events),
      station_(std::move(station)),
      config_(config),
      client_(client),
      heard_(config) {}

void Association::start() {
  spread_ = kFirstSpread;
  scan_anew();
}

void Association::stop() {
  events_.cancel(timer_);
  events_.cancel(loss_);
  heard_.clear();
  change(State::kOff, std::nullopt);
}

void Association::change(State state, std::optional<hal::AgentId> access_point) {
  state_ = state;
  access_point_ = access_point;
  client_.on_association();
}

void Association::scan_anew() {
  const double part = station_.random.uniform();
  const auto more = static_cast<std::int64_t>(part * static_cast<double>(spread_.count()));
  scan(config_.scan_time + hal::Duration{more});
}

void Association::scan(hal::Duration time) {
  change(State::kScanning, std::nullopt);
  timer_ = events_.schedule(events_.now() + time, Rank::kRadio, station_.agent,
                            [this] { on_scanned(); });
}

void Association::on_scanned() {
  if (const auto strongest = heard_.strongest(events_.now())) return begin(*strongest);
  scan(config_.scan_time);
}

void Association::begin(hal::AgentId access_point) {
  target_ = access_point;
  change(State::kAuthenticating, access_point_);
  client_.send(FrameType::kAuthentication, target_, encode(Authentication{}));
  wait_for_answer();
}

void Association::wait_for_answer() {
  events_.cancel(timer_);
  timer_ = events_.schedule(events_.now() + config_.answer_timeout, Rank::kRadio, station_.agent,
                            [this] { give_up(); });
}

/// Forgets the candidate: it must be heard again before it is asked again.
void Association::give_up() {
  events_.cancel(timer_);
  heard_.forget(target_);
  if (access_point_) return change(State::kAssociated, access_point_);
  spread_ = std::clamp(2 * spread_, kSpreadAfterFailure, kLongestSpread);
  if (const auto other = heard_.strongest(events_.now())) return begin(*other);
  scan_anew();
}

void Association::on_beacon(const Frame& frame, hal::Dbm rssi) {
  if (state_ == State::kOff) return;
  const auto beacon = decode_beacon(*frame.payload);
  if (!beacon || beacon->bss.ssid != station_.bss.ssid) return;
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
      return;  // requests, which are for access points
  }
}

void Association::on_authentication(const Frame& frame) {
  if (state_ != State::kAuthenticating || frame.transmitter != target_) return;
  const auto answer = decode_authentication(*frame.payload);
  if (!answer || answer->transaction != 2) return;
  if (answer->status != kStatusSuccess) return give_up();
  state_ = State::kAssociating;
  client_.send(
      access_point_ ? FrameType::kReassociationRequest : FrameType::kAssociationRequest, target_,
      encode(AssociationRequest{.bss = station_.bss, .current_access_point = access_point_}));
  wait_for_answer();
}

void Association::on_response(const Frame& frame) {
  if (state_ != State::kAssociating || frame.transmitter != target_) return;
  const auto answer = decode_association_response(*frame.payload);
  if (!answer) return;
  if (answer->status != kStatusSuccess) return give_up();
  events_.cancel(timer_);
  spread_ = kFirstSpread;
  edca_ = answer->bss.edca;
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
  if (state_ != State::kAssociated) return client_.on_association();  // a handover is in progress
  if (const auto other = heard_.strongest(events_.now())) return begin(*other);
  scan_anew();
}

/// Schedules the check for lost beacons: one pending event, which is scheduled again as long as
/// beacons arrive.
void Association::watch() {
  events_.cancel(loss_);
  const hal::Time at = std::max(events_.now(), heard_.lost_at(*access_point_));
  loss_ = events_.schedule(at, Rank::kRadio, station_.agent, [this] {
    if (heard_.lost_at(*access_point_) > events_.now()) return watch();
    lose();
  });
}

}  // namespace sim::radio
