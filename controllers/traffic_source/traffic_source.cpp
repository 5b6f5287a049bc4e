#include "controllers/traffic_source/traffic_source.h"

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "controllers/traffic_stamp.h"
#include "hal/types/math.h"

namespace controllers {
namespace {

constexpr double kUnset = std::numeric_limits<double>::infinity();
constexpr hal::TimerId kNext = 1;
constexpr hal::TimerId kBegin = 2;

/// In the order of Pattern.
constexpr std::array<const char*, 4> kPatterns{"saturated", "periodic", "poisson", "bursts"};

std::optional<hal::Duration> or_unset(double seconds) {
  if (!std::isfinite(seconds)) return std::nullopt;
  return hal::from_seconds(seconds);
}

std::optional<hal::Time> time_or_never(double seconds) {
  const auto since_start = or_unset(seconds);
  if (!since_start) return std::nullopt;
  return hal::Time{*since_start};
}

/// Time between two messages, or two bursts of them.
hal::Duration period_of(const hal::Parameters& parameters) {
  const double messages = parameters.text("pattern") == "bursts" ? parameters["burst"] : 1;
  return hal::from_seconds(messages / parameters["rate"]);
}

/// A parameter that is used by one pattern only.
struct OfPattern {
  const char* parameter;
  const char* pattern;
};
constexpr std::array<OfPattern, 2> kOfPatterns{{{"backlog", "saturated"}, {"burst", "bursts"}}};

std::vector<hal::ParameterMistake> judge(const hal::Parameters& parameters) {
  std::vector<hal::ParameterMistake> mistakes;
  const double start = parameters["start"], stop = parameters["stop"];
  if (stop < start) {
    mistakes.push_back({"stop", "is before `start`: it would never send"});
  }
  const std::string& pattern = parameters.text("pattern");
  const auto unused = [&](const std::string& name, const std::string& why) {
    if (parameters.is_given(name)) mistakes.push_back({name, "has no effect: " + why, true});
  };
  if (pattern == "saturated") unused("rate", "a saturated source sends as fast as it can");
  if (pattern == "saturated" || pattern == "poisson") {
    unused("phase", "`pattern` is " + pattern + ", which has none");
  }
  for (const OfPattern& one : kOfPatterns) {
    if (pattern == one.pattern) continue;
    unused(one.parameter, "`pattern` is " + pattern + ", it is for " + one.pattern);
  }
  return mistakes;
}

}  // namespace

TrafficSource::TrafficSource(hal::RealWorldObject& self, const hal::Parameters& parameters)
    : self_(self),
      pattern_(pattern_of(parameters.text("pattern"))),
      to_name_(parameters.text("to")),
      topic_(parameters.text("topic")),
      size_(static_cast<std::size_t>(parameters["size"])),
      priority_(static_cast<std::uint8_t>(parameters["priority"])),
      period_(period_of(parameters)),
      phase_(or_unset(parameters["phase"])),
      burst_(static_cast<int>(parameters["burst"])),
      backlog_(static_cast<std::size_t>(parameters["backlog"])),
      start_(hal::from_seconds(parameters["start"])),
      stop_(time_or_never(parameters["stop"])) {}

TrafficSource::Pattern TrafficSource::pattern_of(const std::string& name) {
  std::size_t pattern = 0;
  while (pattern + 1 < kPatterns.size() && name != kPatterns[pattern]) ++pattern;
  return static_cast<Pattern>(pattern);
}

hal::AgentId TrafficSource::destination_of(const std::string& name) const {
  if (name == "everyone") return hal::kEveryone;
  if (name == "neighbours") return hal::kNeighbours;
  const auto address = self_.address_of(name);
  if (!address) throw std::invalid_argument("to: there is no agent '" + name + "'");
  if (*address == self_.id()) throw std::invalid_argument("to: '" + name + "' is the agent itself");
  return *address;
}

void TrafficSource::start() {
  to_ = destination_of(to_name_);
  if (start_ > self_.now()) {
    (void)self_.set_timer(kBegin, start_);
  } else {
    timer(kBegin);
  }
}

void TrafficSource::timer(hal::TimerId id) {
  if (is_over()) return;
  if (pattern_ == Pattern::kSaturated) return fill();
  if (id == kBegin) return wait_for(self_.now() + first_wait());
  const int messages = pattern_ == Pattern::kBursts ? burst_ : 1;
  // With a latency, or in real time, the next one may be due already: the rate is kept.
  hal::Time next = next_;
  while (next <= self_.now() && !is_over()) {
    for (int i = 0; i < messages; ++i) send_one();
    next += next_wait();
  }
  wait_for(next);
}

hal::Duration TrafficSource::first_wait() {
  if (pattern_ == Pattern::kPoisson) return next_wait();
  if (phase_) return *phase_;
  return hal::from_seconds(self_.random().uniform() * hal::to_seconds(period_));
}

hal::Duration TrafficSource::next_wait() {
  if (pattern_ != Pattern::kPoisson) return period_;
  return hal::from_seconds(-hal::math::log(1 - self_.random().uniform()) *
                           hal::to_seconds(period_));
}

void TrafficSource::wait_for(hal::Time next) {
  next_ = next;
  (void)self_.set_timer(kNext, next);
}

void TrafficSource::step() {
  const bool is_due = pattern_ == Pattern::kSaturated && self_.now() >= start_;
  if (is_due && under_way_.empty()) fill();
}

void TrafficSource::fill() {
  while (!is_over() && under_way_.size() < backlog_) send_one();
}

void TrafficSource::send_one() {
  const auto sent =
      self_.send(to_, topic_, stamped({.sent = self_.now(), .number = ++sent_}, size_),
                 {.priority = hal::Priority{priority_}});
  if (!sent) throw std::invalid_argument(sent.error().message);
  if (pattern_ == Pattern::kSaturated) under_way_[*sent] = self_.now();
}

void TrafficSource::notice(hal::MessageId id, hal::Fate fate) {
  ++(fate == hal::Fate::kHandedOver  ? handed_over_
     : fate == hal::Fate::kQueueFull ? queue_full_
                                     : failed_);
  const auto sent = under_way_.extract(id);
  if (sent.empty() || fate == hal::Fate::kQueueFull || sent.mapped() == self_.now()) return;
  if (!is_over()) send_one();
}

void TrafficSource::stop() {
  self_.record("sent", sent_);
  self_.record("handed_over", handed_over_);
  self_.record("failed", failed_);
  self_.record("queue_full", queue_full_);
}

}  // namespace controllers

BARAKA_CONTROLLER {
  using controllers::kUnset;
  return {
      .name = "traffic_source",
      .wants = {.names = true},
      .parameters =
          {{.name = "pattern",
            .default_value = "periodic",
            .meaning = "When it sends.",
            .choices = {controllers::kPatterns.begin(), controllers::kPatterns.end()}},
           {.name = "to",
            .default_value = "neighbours",
            .meaning = "Name of an agent, `neighbours`, or `everyone`.",
            .names = hal::Naming::kOtherAgent,
            .besides = {"everyone"}},
           {.name = "topic",
            .default_value = "traffic",
            .meaning = "Of its messages.",
            .names = hal::Naming::kSentTopic},
           {"size", "1", 100, 0, static_cast<double>(hal::kMaxPayload),
            "Bytes of a message; from 12 on it carries its time and number."},
           {"priority", "1", 0, 0, hal::kHighestPriority,
            "User priority of its messages: 0 best effort, 1 background, 5 video, 6 voice."},
           {"rate", "Hz", 1, 1e-6, 1e6, "Messages per second, on average; not if saturated."},
           {"phase", "s", controllers::kUnset, 0, controllers::kUnset,
            "From `start` to the first message, periodic, or burst; none: drawn from one period."},
           {"burst", "1", 10, 1, 10000, "Messages of a burst."},
           {"backlog", "1", 10, 1, 10000, "Messages under way at any time, if saturated."},
           {"start", "s", 0, 0, 1e9, "When it begins."},
           {"stop", "s", controllers::kUnset, 0, controllers::kUnset, "When it ends."}},
      .judge = controllers::judge,
      .records = {{"sent", "1", "Messages that it sent, told at the end as the others."},
                  {"handed_over", "1", "Of these, taken by the next hop."},
                  {"failed", "1", "Of these, without a route, or never taken."},
                  {"queue_full", "1", "Of these, that found no room in the queue."}},
      .make_for_mote = hal::make_for_mote<controllers::TrafficSource>,
      .make_for_robot = hal::make_for_robot<controllers::TrafficSource>};
}
