#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "controllers/labour/sample_message.h"
#include "hal/api/controller.h"

namespace controllers {

/// What a burst of samples is like.
struct Burst {
  std::string topic{};
  int messages = 1;
  std::size_t size = kSampleBytes;  ///< Bytes of payload of each.
  hal::Duration interval{};         ///< From one to the next.
  int needed = 1;                   ///< At the sink, for it to be a success.
  hal::Duration within{};           ///< From the last message to the sink's receipt.
};

/// messages, size, interval, needed and within, with `prefix` before their names. @param defaults
/// of `needed` it is the share that counts, needed / messages.
std::vector<hal::ParameterSpec> burst_parameters(const std::string& prefix, const Burst& defaults);
/// Their values. @param topic  of the messages.
Burst burst_of(const hal::Parameters& parameters, const std::string& prefix,
               const std::string& topic);

/// Brings bursts of samples to the sink, one at a time. A burst is a success once the sink's
/// receipt is here, and a failure if it is not in time.
class Delivery {
 public:
  /// @param timer  the one of the agent's timers that it uses.
  Delivery(hal::RealWorldObject& self, hal::TimerId timer) : self_(self), timer_(timer) {}

  /// Once, when the agent starts: its bursts are numbered from the milliseconds of that time on, so
  /// that those of an agent that is restarted are none of the sink's past.
  void start();

  /// Sends the first message. What the sink has itself is there at once.
  /// @pre !is_on()
  void begin(const Burst& burst, hal::AgentId sink);
  void cancel() { is_on_ = false; }
  void timer();  ///< Of the timer's number.
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
  std::uint32_t number_ = 0;  ///< Of the last burst.
  int sent_ = 0;              ///< Of its messages.
  bool is_on_ = false;
  bool succeeded_ = false;
};

}  // namespace controllers
