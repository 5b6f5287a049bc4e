#include <hal/api/controller.h>
#include <hal/types/math.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <span>

namespace {

constexpr std::string_view kTopic = "goal";  // message class; routes are kept per class
constexpr hal::TimerId kTell = 1;
constexpr hal::Duration kTellAgain = std::chrono::seconds(1);
constexpr std::size_t kMessageSize = 16;  // x and y in the world, m: IEEE 754, little-endian

hal::Bytes encode(hal::Vec2 place) {
  hal::Bytes bytes;
  for (const double value : {place.x, place.y}) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    for (unsigned shift = 0; shift < 64; shift += 8) {
      bytes.push_back(static_cast<std::uint8_t>(bits >> shift));
    }
  }
  return bytes;
}

double decode(std::span<const std::uint8_t> bytes) {
  std::uint64_t bits = 0;
  for (unsigned i = 0; i < 8; ++i) bits |= std::uint64_t{bytes[i]} << (8 * i);
  return std::bit_cast<double>(bits);
}

}  // namespace

/// Drives around until it is near enough to see the agent `goal`, or another robot sends it the
/// position; sends the position to the others, drives there, and stays.
class TwoTurtlebots : public hal::Controller {
 public:
  TwoTurtlebots(hal::Robot& robot, const hal::Parameters& parameters)
      : robot_(robot),
        speed_(parameters["speed"]),
        keep_off_(parameters["keep_off"]),
        arrive_at_(parameters["arrive_at"]) {}

  void start() override { robot_.state("SEARCHING"); }  // the scenario can wait for states

  void step() override {  // once per control cycle
    const auto pose = robot_.pose();
    const auto scan = robot_.scan();
    if (arrived_ || !pose || !scan) return;  // no reading yet: the first sample takes a moment
    if (!goal_) look_for_goal(*pose);
    const double left = goal_ ? hal::math::hypot(goal_->x - pose->x, goal_->y - pose->y) : INFINITY;
    arrived_ = left < arrive_at_;
    (void)robot_.set_body_velocity(arrived_ ? hal::Twist2{} : steer(*pose, *scan));
    if (arrived_) robot_.state("ARRIVED");
  }

  void timer(hal::TimerId) override {  // periodically, because a broadcast is not repeated
    const auto sent = robot_.send(hal::kEveryone, kTopic, encode(*goal_));
    if (!sent) robot_.log(hal::log::Level::kWarning, sent.error().message);
    (void)robot_.set_timer(kTell, robot_.now() + kTellAgain);
  }

  void receive(const hal::Message& message) override {
    if (goal_ || message.topic != kTopic || message.payload.size() != kMessageSize) return;
    const std::span<const std::uint8_t> bytes(message.payload);
    const hal::Vec2 told{decode(bytes), decode(bytes.subspan(8))};
    if (!std::isfinite(told.x) || !std::isfinite(told.y)) return;
    goal_ = told;
    robot_.state("TOLD");
  }

 private:
  /// The agent is localised only within `localisation.range` of the scenario.
  void look_for_goal(const hal::Pose2& pose) {
    const auto goal = robot_.address_of("goal");
    if (!goal) return;
    const auto seen = robot_.relative_position(*goal);
    if (!seen) return;
    const double c = hal::math::cos(pose.theta), s = hal::math::sin(pose.theta);
    goal_ = {pose.x + c * seen->x - s * seen->y, pose.y + s * seen->x + c * seen->y};
    robot_.state("FOUND");
    (void)robot_.set_timer(kTell, robot_.now());
  }

  /// Steers towards the goal, or straight ahead, and away from obstacles in front.
  hal::Twist2 steer(const hal::Pose2& pose, const hal::Scan& scan) {
    double left = kFar, right = kFar;  // m, distance of the nearest obstacle on each side ahead
    for (std::size_t i = 0; i < scan.headings.size(); ++i) {
      if (hal::math::cos(scan.headings[i]) < kAhead || std::isnan(scan.ranges[i])) continue;
      double& nearest = hal::math::sin(scan.headings[i]) > 0 ? left : right;
      nearest = std::min(nearest, scan.ranges[i]);  // -infinity: too near to be measured
    }
    if (std::min(left, right) < keep_off_) {  // keeps turning the way it began
      if (turn_ == 0) turn_ = left < right ? -1 : 1;
      return {.omega = turn_};
    }
    turn_ = 0;
    if (!goal_) return {.vx = speed_};
    const double towards = hal::math::atan2(goal_->y - pose.y, goal_->x - pose.x);
    const double error = hal::math::wrap_angle(towards - pose.theta);
    return {.vx = std::abs(error) < 1 ? speed_ : 0, .omega = std::clamp(2 * error, -1.0, 1.0)};
  }

  static constexpr double kFar = 10;     // m, beyond the scanner's range
  static constexpr double kAhead = 0.8;  // cosine: 37 degrees to either side

  hal::Robot& robot_;
  const double speed_;             // m/s
  const double keep_off_;          // m
  const double arrive_at_;         // m
  std::optional<hal::Vec2> goal_;  // m, in the world
  double turn_ = 0;                // rad/s, while an obstacle is ahead; otherwise 0
  bool arrived_ = false;
};

BARAKA_CONTROLLER {
  return {.name = "two_turtlebots",
          .wants = {.channels = {"scan", "pose", "localisation"}, .names = true},
          .parameters = {{"speed", "m/s", 0.2, 0.01, 1, "Speed ahead."},
                         {"keep_off", "m", 0.35, 0.1, 2, "Distance at which it turns away."},
                         {"arrive_at", "m", 0.5, 0.1, 5, "Distance to the goal to stop at."}},
          .states = {"SEARCHING", "FOUND", "TOLD", "ARRIVED"},
          .make_for_robot = hal::make_for_robot<TwoTurtlebots>};
}
