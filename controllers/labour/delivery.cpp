#include "controllers/labour/delivery.h"

#include <algorithm>
#include <cmath>

namespace controllers {

std::vector<hal::ParameterSpec> burst_parameters(const std::string& prefix, const Burst& defaults) {
  const double share = static_cast<double>(defaults.needed) / defaults.messages;
  return {
      {prefix + "messages", "1", defaults.messages, 1, 1000, "Messages of a burst."},
      {prefix + "size", "1", static_cast<double>(defaults.size), static_cast<double>(kSampleBytes),
       static_cast<double>(hal::kMaxPayload), "Bytes of a message."},
      {prefix + "interval", "s", hal::to_seconds(defaults.interval), 0, 3600,
       "From one message of a burst to the next."},
      {prefix + "needed", "1", share, 0, 1,
       "Share of a burst's messages that the sink must get for it to be a success."},
      {prefix + "within", "s", hal::to_seconds(defaults.within), 0, 3600,
       "From the last message to the sink's receipt; later, or never, is a failure."}};
}

Burst burst_of(const hal::Parameters& parameters, const std::string& prefix,
               const std::string& topic) {
  const double messages = std::floor(parameters[prefix + "messages"]);
  // 0.9 of 10 is 9, whatever the rounding of 0.9.
  const double needed = std::ceil(parameters[prefix + "needed"] * messages - 1e-9);
  return {.topic = topic,
          .messages = static_cast<int>(messages),
          .size = static_cast<std::size_t>(parameters[prefix + "size"]),
          .interval = hal::from_seconds(parameters[prefix + "interval"]),
          .needed = std::max(1, static_cast<int>(needed)),
          .within = hal::from_seconds(parameters[prefix + "within"])};
}

void Delivery::start() {
  number_ =
      static_cast<std::uint32_t>(self_.now().time_since_epoch() / std::chrono::milliseconds{1});
}

void Delivery::begin(const Burst& burst, hal::AgentId sink) {
  burst_ = burst;
  sink_ = sink;
  ++number_;
  sent_ = 0;
  is_on_ = true;
  if (sink_ == self_.id()) return end(true);
  send_next();
}

void Delivery::timer() {
  if (!is_on_) return;
  if (sent_ < burst_.messages) return send_next();
  end(false);
}

void Delivery::send_next() {
  const SampleMessage sample{.burst = number_,
                             .index = static_cast<std::uint16_t>(sent_),
                             .needed = static_cast<std::uint16_t>(burst_.needed)};
  // The HAL logs what it refuses; there is then no receipt.
  (void)self_.send(sink_, burst_.topic, encode(sample, burst_.size));
  ++sent_;
  (void)self_.set_timer(timer_,
                        self_.now() + (sent_ < burst_.messages ? burst_.interval : burst_.within));
}

void Delivery::receive(const hal::Message& message) {
  if (!is_on_ || message.source != sink_ || message.topic != burst_.topic) return;
  if (receipt_in(message.payload) == number_) end(true);
}

void Delivery::end(bool succeeded) {
  is_on_ = false;
  succeeded_ = succeeded;
}

}  // namespace controllers
