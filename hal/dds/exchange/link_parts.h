#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hal/dds/exchange/endpoints.h"
#include "hal/dds/exchange/process_link.h"
#include "hal/dds/process_watch.h"
#include "hal/exchange/session.h"
#include "hal/types/time.h"

namespace hal::dds {

/// "baraka/<process>/step" and "baraka/<process>/reply".
std::string step_topic(const std::string& process);
std::string reply_topic(const std::string& process);
inline constexpr const char* kHelloTopic = "baraka/hello";
inline constexpr const char* kSessionTopic = "baraka/session";

/// What a link is made from.
struct LinkSettings {
  std::string server;
  exchange::Hello hello;
  hal::rtps::GuidPrefix participant;  ///< Whose Hello it was, and whose Replies count.
  std::uint64_t run = 0;
  std::optional<Duration> reply_timeout;
  /// Whether the process was not heard for the liveliness lease. Asked if it is on another host.
  std::function<bool()> is_silent;
};

class ProcessLink::Implementation {
 public:
  Implementation(Participant& participant, LinkSettings settings);

  Result<void> begin(const exchange::Step& step);
  Result<exchange::Reply> finish();
  Result<std::optional<exchange::Reply>> try_finish();
  std::vector<int> descriptors() const { return {signal_.descriptor(), watch_.descriptor()}; }
  Result<void> check_alive();

  const std::string& name() const { return settings_.hello.process; }
  const DroppedReplies& dropped() const { return dropped_; }
  int death_descriptor() const { return watch_.descriptor(); }

 private:
  /// The Reply that is waited for, if it is there. Drops others.
  std::optional<exchange::Reply> take_reply();
  bool answers_step(const wire::Reply& reply) const;
  bool is_of_the_process(const Origin& origin);
  Result<void> write();
  void wait(const Deadline& deadline) const;
  bool is_dead() const;
  tl::unexpected<Error> death() const;

  LinkSettings settings_;
  ProcessWatch watch_;
  Signal signal_;
  Writer<wire::Step> steps_;
  Reader<wire::Reply> replies_;
  wire::Step step_;  ///< The Step under way, as it was written …
  Deadline resend_;  ///< … and when it is written again.
  Time at_{};        ///< Of the Step under way.
  DroppedReplies dropped_;
};

}  // namespace hal::dds
