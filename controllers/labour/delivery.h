#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "controllers/labour/sample_message.h"
#include "hal/api/controller.h"

namespace controllers {

/// Properties of a burst of samples.
struct Burst {
  std::string topic{};
  int messages = 1;
  std::size_t size = kSampleBytes;  ///< Payload of each message, bytes.
  hal::Duration interval{};         ///< Time between two messages.
  int needed = 1;                   ///< Messages that the sink must receive for a success.
  hal::Duration within{};           ///< Longest time from the last message to the sink's receipt.
};

/// Parameters messages, size, interval, needed and within, with `prefix` before their names.
/// `needed` is the required share of the messages.
/// @param defaults  default values
std::vector<hal::ParameterSpec> burst_parameters(const std::string& prefix, const Burst& defaults);
/// The burst that these parameters describe. @param topic  of its messages.
Burst burst_of(const hal::Parameters& parameters, const std::string& prefix,
               const std::string& topic);

/// Sends bursts of samples to the sink, one at a time. A burst succeeds if the sink's receipt
/// arrives in time, and fails otherwise.
class Delivery {
 public:
  /// @param timer  the id of the agent's timer that it uses.
  Delivery(hal::RealWorldObject& self, hal::TimerId timer) : self_(self), timer_(timer) {}

  /// Call once, when the agent starts: bursts are numbered from the current time in milliseconds,
  /// so that those of a restarted agent are new to the sink.
  void start();

  /// Sends the first message. The sink's own bursts succeed at once.
  /// @pre !is_on()
  void begin(const Burst& burst, hal::AgentId sink);
  void cancel() { is_on_ = false; }
  void timer();  ///< Call when the timer of that id expires.
  void receive(const hal::Message& message);

  bool is_on() const { return is_on_; }
  /// Whether the last burst that ended was a success.
  bool succeeded() const { return succeeded_; }

 private:
  void send_next();
  void end(bool succeeded);

  hal::RealWorldObject& self_;
  const hal::TimerId timer_;
  Burst burst_;
  hal::AgentId sink_;
  std::uint32_t number_ = 0;  ///< Number of the last burst.
  int sent_ = 0;              ///< Number of messages sent in this burst.
  bool is_on_ = false;
  bool succeeded_ = false;
};

}  // namespace controllers
