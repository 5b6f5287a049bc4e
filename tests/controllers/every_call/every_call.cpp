#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "hal/api/controller.h"
#include "hal/types/math.h"
#include "hal/types/path_metric.h"

/// Makes every call of hal/api and writes each result to the log: tests/e2e/python/every_call.py
/// makes the same ones, and writes the same lines.
class EveryCall : public hal::Controller {
 public:
  EveryCall(hal::Robot& robot, const hal::Parameters& parameters)
      : EveryCall(robot, &robot, parameters) {}
  EveryCall(hal::Mote& mote, const hal::Parameters& parameters)
      : EveryCall(mote, nullptr, parameters) {}

  void start() override {
    say("start {} {} {:.17g} '{}'", agent_.id().value, agent_.name(),
        hal::to_seconds(agent_.control_period()), agent_.air_interface());
    say("parameters {:.17g} {} {} [{:.17g}] [{}] {} {}", parameters_["number"],
        static_cast<int>(parameters_.flag("flag")), parameters_.text("text"),
        fmt::join(parameters_.numbers("numbers"), " "), fmt::join(parameters_.texts("texts"), " "),
        static_cast<int>(parameters_.is_given("number")),
        static_cast<int>(parameters_.is_given("flag")));
    const auto other = agent_.address_of("m0");
    say("names {} {} {}", other ? other->value : 0, agent_.name_of(hal::AgentId{1}).value_or("-"),
        static_cast<int>(agent_.address_of("nobody").has_value()));
    for (const hal::Channel& c : agent_.channels()) {
      say("channel {} {} {} {} {} {:.17g} {} [{:.17g}] {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} "
          "{:.17g}",
          c.id, c.name, c.kind, c.unit, c.length, hal::to_seconds(c.period), c.frame,
          fmt::join(c.headings, " "), c.low, c.high, c.position.x, c.position.y, c.position.z,
          c.heading);
    }
    check(agent_.set_timer(7, agent_.now() + std::chrono::milliseconds{250}));
    check(agent_.set_timer(8, hal::Time{}));
    if (robot_ != nullptr) say_body();
    agent_.state("RUNNING");
  }

  void step() override {
    hal::RandomStream& random = agent_.random();
    const std::uint64_t bits = random.next();
    const std::uint32_t below = random.below(6);
    const double uniform = random.uniform();
    say("step {} {:.17g} {} {} {:.17g} {:.17g}", hal::to_ns(agent_.now()),
        hal::to_seconds(agent_.now()), bits, below, uniform, random.normal());
    agent_.record("now", hal::to_seconds(agent_.now()));
    say_power();
    say_network();
    if (robot_ != nullptr) say_robot();
    if (++steps_ == 12) agent_.set_radio(false);
    if (steps_ == 14) agent_.set_radio(true);
  }

  void receive(const hal::Message& m) override {
    say("receive {} {} {} {} [{}] {}", m.source.value, m.destination.value, m.id, m.topic,
        fmt::join(m.payload, " "), hal::to_number(m.priority));
  }
  void timer(hal::TimerId id) override {
    say("timer {} {}", id, hal::to_ns(agent_.now()));
    check(agent_.network().invalidate("every", hal::AgentId{2}));
    check(agent_.network().invalidate("", hal::AgentId{2}));
  }
  void notice(hal::MessageId id, hal::Fate fate) override {
    say("notice {} {}", id, hal::to_string(fate));
  }
  void stop() override { say("stop {}", hal::to_ns(agent_.now())); }

 private:
  EveryCall(hal::RealWorldObject& agent, hal::Robot* robot, hal::Parameters parameters)
      : agent_(agent), robot_(robot), parameters_(std::move(parameters)) {}

  template <class... Args>
  void say(fmt::format_string<Args...> format, Args&&... args) {
    agent_.log(hal::log::Level::kInfo, fmt::format(format, std::forward<Args>(args)...));
  }
  template <class T>
  bool check(const hal::Result<T>& result) {
    if (!result) say("error {} {}", static_cast<int>(result.error().code), result.error().message);
    return result.has_value();
  }
  void say_number(const char* what, const hal::Result<double>& number) {
    if (check(number)) say("{} {:.17g}", what, *number);
  }

  void say_body() {
    const hal::RobotBody& body = robot_->body();
    say("body {}", body.model);
    for (const hal::Solid& s : body.solids) {
      say("solid {} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}",
          static_cast<int>(s.shape), s.size.x, s.size.y, s.size.z, s.centre.x, s.centre.y,
          s.centre.z, s.yaw);
    }
    for (const hal::BodyWheel& w : body.wheels) {
      say("wheel {} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}",
          static_cast<int>(w.is_driven), w.position.x, w.position.y, w.axle_heading, w.roller_angle,
          w.radius, w.max_speed, w.max_torque);
    }
  }

  void say_power() {
    say_number("battery", agent_.battery());
    say_number("energy", agent_.battery_energy());
    say_number("capacity", agent_.battery_capacity());
    const auto values = agent_.reading("battery");
    if (check(values)) say("reading [{:.17g}]", fmt::join(*values, " "));
    check(agent_.reading("nothing"));
    const auto place = agent_.relative_position(hal::AgentId{2});
    if (check(place)) say("place {:.17g} {:.17g}", place->x, place->y);
  }

  void say_network() {
    const std::vector<std::uint8_t> payload{0, 255, 7};
    const hal::AgentId to = agent_.id() == hal::AgentId{1} ? hal::AgentId{2} : hal::AgentId{1};
    for (const hal::AgentId destination : {to, hal::kEveryone, hal::kNeighbours, agent_.id()}) {
      const auto id =
          agent_.send(destination, "every", payload, {.priority = hal::Priority::kVideo});
      if (check(id)) say("sent {}", *id);
    }
    const std::vector<hal::Route> routes = std::as_const(agent_).network().routes("every", to);
    for (const hal::Route& r : routes) {
      say("route {} {} {} {} {:.17g} {:.17g} {:.17g}", r.topic, r.destination.value,
          r.next_hop.value, r.path.hops, hal::to_seconds(r.path.delay), r.path.min_snr_db,
          r.path.energy);
    }
    if (!routes.empty()) {
      const auto metric = hal::path_metric(hal::PathStatistic::kDelay, 0);
      say("drawn {}", hal::draw_route(routes, metric, 2, agent_.random()));
    }
    for (const hal::Neighbour& n : agent_.network().neighbours()) {
      say("neighbour {} {:.17g} {:.17g}", n.id.value, hal::to_seconds(n.last_heard), n.rssi_dbm);
    }
  }

  void say_robot() {
    if (steps_ % 4 == 3) {
      check(robot_->set_wheel_speeds(std::vector<double>{1, 1}));
      check(robot_->set_wheel_speeds(std::vector<double>{1000, 1}));
      check(robot_->set_wheel_speeds(std::vector<double>{1}));
    } else {
      const auto drive = robot_->set_body_velocity({.vx = 3, .vy = 0.1, .omega = 0.2});
      if (check(drive)) {
        say("drive {:.17g} {:.17g} {:.17g} {} {}", drive->applied.vx, drive->applied.vy,
            drive->applied.omega, static_cast<int>(drive->saturated),
            static_cast<int>(drive->restricted));
      }
    }
    say_sensors();
  }

  void say_sensors() {
    const auto infrared = robot_->infrared();
    if (check(infrared)) {
      for (const auto& [heading, range] : *infrared)
        say("infrared {:.17g} {:.17g}", heading, range);
    }
    const auto odometry = robot_->odometry();
    if (check(odometry)) {
      say("odometry {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}", odometry->pose.x,
          odometry->pose.y, odometry->pose.theta, odometry->twist.vx, odometry->twist.vy,
          odometry->twist.omega);
    }
    const auto scan = robot_->scan();
    if (check(scan)) {
      say("scan [{:.17g}] [{:.17g}]", fmt::join(scan->headings, " "), fmt::join(scan->ranges, " "));
    }
    const auto imu = robot_->imu();
    if (check(imu)) {
      say("imu {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}", imu->angular_velocity.x,
          imu->angular_velocity.y, imu->angular_velocity.z, imu->specific_force.x,
          imu->specific_force.y, imu->specific_force.z);
    }
    const auto bumped = robot_->bumped();
    if (check(bumped)) say("bumped {}", static_cast<int>(*bumped));
    const auto pose = robot_->pose();
    if (check(pose)) say("pose {:.17g} {:.17g} {:.17g}", pose->x, pose->y, pose->theta);
    say("math {:.17g} {:.17g} {:.17g}", hal::math::sin(steps_), hal::math::atan2(steps_, 3),
        hal::math::wrap_angle(steps_));
  }

  hal::RealWorldObject& agent_;
  hal::Robot* robot_;
  const hal::Parameters parameters_;
  int steps_ = 0;
};

BARAKA_CONTROLLER {
  return {.name = "every_call",
          .wants = {.channels = {},
                    .watched = {"every"},
                    .neighbours = true,
                    .optional = {"battery", "infrared", "odometry", "scan", "imu", "bumper", "pose",
                                 "localisation"},
                    .names = true},
          .parameters = {{"number", "m/s", 0.5, 0, 2, "A number."},
                         {.name = "flag", .default_value = false, .meaning = "A flag."},
                         {.name = "text",
                          .default_value = "near",
                          .meaning = "A text.",
                          .choices = {"near", "far"}},
                         {.name = "numbers",
                          .unit = "m",
                          .default_value = std::vector<double>{},
                          .low = -100,
                          .high = 100,
                          .meaning = "Numbers."},
                         {.name = "texts",
                          .default_value = std::vector<std::string>{},
                          .meaning = "Texts."}},
          .states = {"RUNNING"},
          .records = {{"now", "s", "The time."}},
          .make_for_mote = hal::make_for_mote<EveryCall>,
          .make_for_robot = hal::make_for_robot<EveryCall>};
}
