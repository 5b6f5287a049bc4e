#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "controllers/traffic_stamp.h"
#include "hal/api/controller.h"

namespace controllers {

/// Counts the messages of traffic sources. At the end of the run it records, for messages received
/// between `start` and `stop`: `received` (number), `bytes` (of payload), `goodput` (bit/s of
/// payload plus `overhead` bytes per message) and, if any message had a stamp, `latency_mean` and
/// `latency_max` (s, from the source's send() to receive() here).
class TrafficSink : public hal::Controller {
 public:
  TrafficSink(hal::RealWorldObject& self, const hal::Parameters& parameters)
      : self_(self),
        topic_(parameters.text("topic")),
        overhead_(parameters["overhead"]),
        start_(parameters["start"]),
        stop_(parameters["stop"]) {}

  void receive(const hal::Message& message) override {
    const double now = hal::to_seconds(self_.now());
    if (message.topic != topic_ || now < start_ || now >= stop_) return;
    ++received_;
    bytes_ += message.payload.size();
    const auto stamp = stamp_in(message.payload);
    if (!stamp) return;
    ++stamped_;
    const hal::Duration latency = self_.now() - stamp->sent;
    latency_sum_ += hal::to_seconds(latency);
    latency_max_ = std::max(latency_max_, latency);
  }

  void stop() override {
    const double time = std::min(stop_, hal::to_seconds(self_.now())) - start_;
    const double received = static_cast<double>(received_);
    const double bytes = static_cast<double>(bytes_);
    self_.record("received", received);
    self_.record("bytes", bytes);
    if (time > 0) self_.record("goodput", 8 * (bytes + overhead_ * received) / time);
    if (stamped_ == 0) return;
    self_.record("latency_mean", latency_sum_ / static_cast<double>(stamped_));
    self_.record("latency_max", hal::to_seconds(latency_max_));
  }

 private:
  hal::RealWorldObject& self_;
  const std::string topic_;
  const double overhead_;      ///< bytes
  const double start_, stop_;  ///< s
  std::uint64_t received_ = 0, bytes_ = 0, stamped_ = 0;
  double latency_sum_ = 0;  ///< s
  hal::Duration latency_max_{};
};

std::vector<hal::ParameterMistake> judge(const hal::Parameters& parameters) {
  if (parameters["stop"] > parameters["start"]) return {};
  return {{"stop", "is not after `start`: it would never count"}};
}

}  // namespace controllers

BARAKA_CONTROLLER {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  return {.name = "traffic_sink",
          .parameters = {{.name = "topic",
                          .default_value = "traffic",
                          .meaning = "Of the messages it counts; it ignores others.",
                          .names = hal::Naming::kHeardTopic},
                         {"overhead", "1", 0, 0, 2304,
                          "Bytes of each message, beside the payload, that count in `goodput`."},
                         {"start", "s", 0, 0, 1e9, "Messages before it are not counted."},
                         {"stop", "s", kNever, 0, kNever, "Messages from then on likewise."}},
          .judge = controllers::judge,
          .records = {{"received", "1", "Messages counted, told at the end as the others."},
                      {"bytes", "1", "Of their payloads."},
                      {"goodput", "bit/s", "Of their payloads and `overhead`."},
                      {"latency_mean", "s", "From sending to arrival, of those with a time."},
                      {"latency_max", "s", "The longest of these."}},
          .make_for_mote = hal::make_for_mote<controllers::TrafficSink>,
          .make_for_robot = hal::make_for_robot<controllers::TrafficSink>};
}
