#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "hal/api/controller.h"

namespace controllers {

/// Sends messages that say nothing, to one agent or to whoever hears it, from `start` until `stop`:
///
///   saturated   `backlog` messages are under way at any time: each notice of what became of one is
///               answered with the next
///   periodic    one every 1 / rate, the first `phase` after the start
///   poisson     the times between two are exponential, 1 / rate on average
///   bursts      `burst` at once, every burst / rate, the first `phase` after the start
///
/// A message that the queue had no room for is not replaced, so that a saturated source keeps the
/// queue full and no more. What is lost or handed over in the very instant in which it was sent (a
/// radio that is off, or instant) is replaced with the next control cycle only.
///
/// At the end it records `sent`, `handed_over`, `failed` and `queue_full`: messages.
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
  const std::size_t size_;                    ///< bytes
  const hal::Duration period_;                ///< Between two messages, or bursts; on average.
  const std::optional<hal::Duration> phase_;  ///< Nothing: drawn.
  const int burst_;
  const std::size_t backlog_;
  const hal::Time start_;
  const std::optional<hal::Time> stop_;

  hal::AgentId to_;
  hal::Time next_{};
  std::map<hal::MessageId, hal::Time> under_way_;  ///< When they were sent.
  std::uint32_t sent_ = 0, handed_over_ = 0, failed_ = 0, queue_full_ = 0;
};

}  // namespace controllers
