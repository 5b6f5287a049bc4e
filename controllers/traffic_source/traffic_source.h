#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "hal/api/controller.h"

namespace controllers {

/// Sends messages without content, to one agent or to its neighbours, from `start` until `stop`:
///
///   saturated   keeps `backlog` messages under way: each notice of a message's fate triggers the
///               next message
///   periodic    one every 1 / rate, the first `phase` after the start
///   poisson     exponential intervals with the mean 1 / rate
///   bursts      `burst` at once, every burst / rate, the first `phase` after the start
///
/// A message refused by a full queue is not replaced, so that a saturated source keeps the queue
/// full but no more. A message whose fate is known in the instant in which it was sent (the radio
/// is off, or delivers instantly) is replaced only at the next control cycle.
///
/// At the end it records the numbers of messages `sent`, `handed_over`, `failed` and `queue_full`.
class TrafficSource : public hal::Controller {
 public:
  TrafficSource(hal::RealWorldObject& self, const hal::Parameters& parameters);

  void start() override;
  void step() override;
  void timer(hal::TimerId id) override;
  void notice(hal::MessageId id, hal::Fate fate) override;
  void stop() override;

 private:
  enum class Pattern : std::uint8_t { kSaturated, kPeriodic, kPoisson, kBursts };

  static Pattern pattern_of(const std::string& name);
  hal::AgentId destination_of(const std::string& name) const;
  bool is_over() const { return stop_ && self_.now() >= *stop_; }
  hal::Duration first_wait();
  hal::Duration next_wait();
  void fill();
  void send_one();
  void wait_for(hal::Time next);

  hal::RealWorldObject& self_;
  const Pattern pattern_;
  const std::string to_name_, topic_;
  const std::size_t size_;  ///< bytes
  const std::uint8_t priority_;
  const hal::Duration period_;  ///< Time between messages or bursts; a mean for poisson.
  const std::optional<hal::Duration> phase_;  ///< nullopt: drawn at random.
  const int burst_;
  const std::size_t backlog_;
  const hal::Time start_;
  const std::optional<hal::Time> stop_;

  hal::AgentId to_;
  hal::Time next_{};
  std::map<hal::MessageId, hal::Time> under_way_;  ///< Times at which they were sent.
  std::uint32_t sent_ = 0, handed_over_ = 0, failed_ = 0, queue_full_ = 0;
};

}  // namespace controllers
