#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gateway/exchange/endpoints.h"
#include "gateway/exchange/process_link.h"
#include "gateway/process/process_watch.h"
#include "hal/node/exchange/session.h"
#include "hal/types/time.h"

namespace gateway::exchange {

/// Names of topics: "baraka/<process>/step" and "baraka/<process>/reply".
std::string step_topic(const std::string& process);
std::string reply_topic(const std::string& process);
inline constexpr const char* kHelloTopic = "baraka/hello";
inline constexpr const char* kSessionTopic = "baraka/session";

/// What a link is created from.
struct LinkSettings {
  std::string server;
  hal::node::exchange::Hello hello;
  hal::rtps::GuidPrefix participant;  ///< Sender of the Hello; only its Replies are accepted.
  std::uint64_t run = 0;
  std::optional<hal::Duration> reply_timeout;
  /// Whether the process has been silent for the liveliness lease. Used if it is on another host.
  std::function<bool()> is_silent;
};

class ProcessLink::Implementation {
 public:
  Implementation(domain::Participant& participant, LinkSettings settings);

  hal::Result<void> begin(const hal::node::exchange::Step& step);
  hal::Result<hal::node::exchange::Reply> finish();
  hal::Result<std::optional<hal::node::exchange::Reply>> try_finish();
  std::vector<int> descriptors() const { return {signal_.descriptor(), watch_.descriptor()}; }
  hal::Result<void> check_alive();

  const std::string& name() const { return settings_.hello.process; }
  const DroppedReplies& dropped() const { return dropped_; }
  int death_descriptor() const { return watch_.descriptor(); }

 private:
  /// The Reply to the current Step, if it has arrived. Other Replies are dropped.
  std::optional<hal::node::exchange::Reply> take_reply();
  /// Counts a malformed Reply; the first one is logged.
  void on_malformed(const hal::Error& error);
  bool answers_step(const wire::Reply& reply) const;
  bool is_of_the_process(const Origin& origin);
  hal::Result<void> write();
  void wait(const process::Deadline& deadline) const;
  bool is_dead() const;
  tl::unexpected<hal::Error> death() const;

  LinkSettings settings_;
  process::ProcessWatch watch_;
  process::Signal signal_;
  Writer<wire::Step> steps_;
  Reader<wire::Reply> replies_;
  wire::Step step_;           ///< The current Step, as it was written.
  process::Deadline resend_;  ///< When the Step is written again.
  hal::Time at_{};            ///< Simulated time of the current Step.
  DroppedReplies dropped_;
};

}  // namespace gateway::exchange
