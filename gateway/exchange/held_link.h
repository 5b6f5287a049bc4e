#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gateway/exchange/controller_link.h"
#include "gateway/exchange/held_channel.h"
#include "gateway/process/process_watch.h"
#include "gateway/process/waiting.h"
#include "hal/node/exchange/session.h"

namespace gateway::exchange {

/// What the run does for a controller that it holds in lock-step.
struct HeldTurns {
  /// Lets the programs of the controller's agent go on, at the present simulated time, until all
  /// wait. @param may_go_on  asked now and then meanwhile; once false, they do not go on any more.
  std::function<void(const std::function<bool()>& may_go_on)> give;
  std::function<hal::Time()> now;  ///< Simulated time.
};

/// The server's end of the exchange with one controller that is held in lock-step. It answers at
/// the simulated time of the Step if it waits for nothing; if it does, simulated time passes.
///
///   HeldLink link(turns);
///   … start the process with link.variable() in its environment and link.descriptor() open as
///     descriptor 3; link.started() …
///   hello = link.hello(limit);
///   link.admit(session, run, reply_timeout);       // or refuse(session)
class HeldLink final : public ControllerLink {
 public:
  /// @throws std::runtime_error  no descriptor is left.
  explicit HeldLink(HeldTurns turns);

  /// Of the environment of the process.
  std::pair<std::string, std::string> variable() const;
  /// The descriptor for the process; closed here by started().
  int controllers_end() const { return controllers_end_.number(); }
  void started() { controllers_end_ = {}; }

  /// Lets the process go on, and takes its Hello, with its identity in this pid namespace.
  /// @param limit  of wall time, for it to wait for an answer.
  std::optional<hal::node::exchange::Hello> hello(const process::Deadline& limit);
  /// Refuses it, and lets it end. @param session  with the reason. @param limit  as above.
  void refuse(const hal::node::exchange::Session& session, const process::Deadline& limit);
  /// Grants the agents of the session. The process is told with its first Step: its controller is
  /// made when its agent starts, not when the first of all agents does.
  /// @param reply_timeout  of simulated time, while it waits, and of wall time, while it computes;
  /// none: no limit.
  void admit(const hal::node::exchange::Session& session, std::uint64_t run,
             std::optional<hal::Duration> reply_timeout);

  const std::string& name() const override { return hello_.process; }
  hal::Result<void> begin(const hal::node::exchange::Step& step) override;
  /// The same as try_finish(), except that an answer that is not there is an error: kTimeout.
  hal::Result<hal::node::exchange::Reply> finish() override;
  /// Errors: also kTimeout.
  hal::Result<std::optional<hal::node::exchange::Reply>> try_finish() override;
  bool shares_time() const override { return true; }
  std::vector<int> descriptors() const override { return {channel_.descriptor()}; }
  hal::Result<void> check_alive() override;

  const DroppedReplies& dropped() const override { return dropped_; }
  int death_descriptor() const override { return watch_ ? watch_->descriptor() : -1; }

 private:
  HeldLink(HeldTurns turns, HeldEnds ends);
  void send(const hal::node::exchange::Session& session);
  bool goes_on();
  std::optional<hal::node::exchange::Reply> take_reply();
  bool is_dead() const;
  tl::unexpected<hal::Error> death() const;
  tl::unexpected<hal::Error> silence(const char* of_time) const;

  HeldTurns turns_;
  process::OwnedDescriptor controllers_end_;
  HeldChannel channel_;
  hal::node::exchange::Hello hello_;
  std::optional<process::ProcessWatch> watch_;  ///< From the Hello on.
  std::uint64_t run_ = 0, sequence_ = 0;
  std::optional<hal::Duration> reply_timeout_;
  hal::Time at_{}, begun_{};  ///< Simulated time: of the Step, and when it began.
  std::optional<process::Deadline> limit_;
  bool is_late_ = false;  ///< It has computed for too long, and was killed.
  DroppedReplies dropped_;
};

}  // namespace gateway::exchange
