#include "sim/agents/path.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "hal/types/math.h"
#include "hal/types/random.h"

namespace sim::agents {
namespace {

using hal::Duration;
using hal::Time;
using hal::Vec2;

hal::Vec2 direction(double heading) { return {hal::math::cos(heading), hal::math::sin(heading)}; }

class StandingPath final : public Path {
 public:
  explicit StandingPath(const hal::Pose2& pose) : pose_(pose) {}
  PathState at(Time) const override { return {{pose_.x, pose_.y}, {}, pose_.theta, Time::max()}; }
  double max_speed() const override { return 0; }

 private:
  const hal::Pose2 pose_;
};

class RoundPath final : public Path {
 public:
  RoundPath(const CirclePath& circle, const hal::Pose2& start)
      : radius_(circle.radius), speed_(circle.speed), turn_(circle.clockwise ? -1 : 1) {
    const Vec2 ahead = direction(start.theta);
    centre_ = Vec2{start.x, start.y} + turn_ * radius_ * Vec2{-ahead.y, ahead.x};
    first_ = start.theta - turn_ * hal::math::kPi / 2;
  }

  PathState at(Time at) const override {
    const double laps = hal::to_seconds(at) * speed_ / (2 * hal::math::kPi * radius_);
    const double angle = first_ + turn_ * 2 * hal::math::kPi * (laps - std::floor(laps));
    const Vec2 outwards = direction(angle);
    const Vec2 ahead = turn_ * Vec2{-outwards.y, outwards.x};
    return {centre_ + radius_ * outwards, speed_ * ahead,
            hal::math::wrap_angle(angle + turn_ * hal::math::kPi / 2), at + Duration{1}};
  }
  double max_speed() const override { return speed_; }

 private:
  const double radius_, speed_, turn_;
  Vec2 centre_;
  double first_ = 0;  ///< First angle [rad], seen from the centre.
};

/// A straight segment at constant speed, or a stop.
struct Leg {
  Time begin{}, end{};
  Vec2 from, to;
  Vec2 velocity;
  double heading = 0;
};

/// Supplies the goals of a tour, listed or drawn.
class Goals {
 public:
  virtual ~Goals() = default;
  struct Goal {
    Vec2 point;
    double speed = 0;  ///< m/s
  };
  /// The next goal; nullopt: the agent stays for ever. @param number  increases from 0; 0 again
  /// restarts the sequence.
  virtual std::optional<Goal> goal(std::uint64_t number) = 0;
  virtual Duration pause() const = 0;
  virtual double max_speed() const = 0;
};

class ListedGoals final : public Goals {
 public:
  explicit ListedGoals(WaypointPath path) : path_(std::move(path)) {}
  std::optional<Goal> goal(std::uint64_t number) override {
    if (number >= path_.points.size() && !path_.repeat) return std::nullopt;
    return Goal{path_.points[number % path_.points.size()], path_.speed};
  }
  Duration pause() const override { return path_.pause; }
  double max_speed() const override { return path_.speed; }

 private:
  const WaypointPath path_;
};

class DrawnGoals final : public Goals {
 public:
  DrawnGoals(const RandomWaypointPath& path, std::uint64_t seed, const std::string& agent)
      : path_(path), fresh_(seed, agent + "/path"), random_(fresh_) {}
  std::optional<Goal> goal(std::uint64_t number) override {
    if (number == 0) random_ = fresh_;
    const auto between = [this](double low, double high) {
      return low + random_.uniform() * (high - low);
    };
    const double x = between(path_.from.x, path_.to.x), y = between(path_.from.y, path_.to.y);
    return Goal{{x, y}, between(path_.speed_low, path_.speed_high)};
  }
  Duration pause() const override { return path_.pause; }
  double max_speed() const override { return path_.speed_high; }

 private:
  const RandomWaypointPath path_;
  const hal::RandomStream fresh_;
  hal::RandomStream random_;
};

/// Moves from goal to goal. Caches the leg that was used last.
class Tour final : public Path {
 public:
  Tour(const hal::Pose2& start, std::unique_ptr<Goals> goals)
      : start_(start), goals_(std::move(goals)) {
    begin();
  }

  PathState at(Time at) const override {
    if (at < leg_.begin) begin();
    while (at >= leg_.end) advance();
    if (leg_.velocity == Vec2{}) return {leg_.from, {}, leg_.heading, leg_.end};
    const double seconds = hal::to_seconds(at - leg_.begin);
    return {leg_.from + seconds * leg_.velocity, leg_.velocity, leg_.heading, at + Duration{1}};
  }
  double max_speed() const override { return goals_->max_speed(); }

 private:
  void begin() const {
    number_ = 0;
    leg_ = {.from = {start_.x, start_.y}, .to = {start_.x, start_.y}, .velocity = {}};
    leg_.heading = start_.theta;
    is_due_to_pause_ = false;
  }

  void advance() const {
    leg_.begin = leg_.end;
    leg_.from = leg_.to;
    leg_.velocity = {};
    if (std::exchange(is_due_to_pause_, false) && goals_->pause() > Duration{}) {
      leg_.end = leg_.begin + goals_->pause();
      return;
    }
    const auto goal = goals_->goal(number_++);
    if (!goal) {
      leg_.end = Time::max();
      return;
    }
    const Vec2 way = goal->point - leg_.from;
    const double metres = hal::math::hypot(way.x, way.y);
    is_due_to_pause_ = true;
    if (metres == 0) return;
    leg_.to = goal->point;
    leg_.end = leg_.begin + std::max(hal::from_seconds(metres / goal->speed), Duration{1});
    leg_.velocity = goal->speed / metres * way;
    leg_.heading = hal::math::atan2(way.y, way.x);
  }

  const hal::Pose2 start_;
  const std::unique_ptr<Goals> goals_;
  mutable std::uint64_t number_ = 0;  ///< Number of the next goal.
  mutable bool is_due_to_pause_ = false;
  mutable Leg leg_;
};

/// There and back. An infinite line is cut at a length that takes kNever.
WaypointPath waypoints(const LinePath& line, const hal::Pose2& start) {
  constexpr double kNever = 1e8;  // s, some three years
  const Vec2 here{start.x, start.y};
  const Vec2 there = here + std::min(line.length, kNever * line.speed) * direction(start.theta);
  return {.points = {there, here}, .speed = line.speed, .pause = line.pause, .repeat = true};
}

}  // namespace

std::unique_ptr<Path> make_path(const PathDescription& description, const hal::Pose2& start,
                                std::uint64_t seed, const std::string& agent) {
  if (const auto* line = std::get_if<LinePath>(&description)) {
    return std::make_unique<Tour>(start, std::make_unique<ListedGoals>(waypoints(*line, start)));
  }
  if (const auto* circle = std::get_if<CirclePath>(&description)) {
    return std::make_unique<RoundPath>(*circle, start);
  }
  if (const auto* listed = std::get_if<WaypointPath>(&description)) {
    return std::make_unique<Tour>(start, std::make_unique<ListedGoals>(*listed));
  }
  if (const auto* drawn = std::get_if<RandomWaypointPath>(&description)) {
    return std::make_unique<Tour>(start, std::make_unique<DrawnGoals>(*drawn, seed, agent));
  }
  return std::make_unique<StandingPath>(start);
}

}  // namespace sim::agents
