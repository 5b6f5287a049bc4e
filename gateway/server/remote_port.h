#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "gateway/exchange/controller_link.h"
#include "gateway/server/action_check.h"
#include "gateway/server/server.h"

namespace gateway::server {

/// The port of a host to one controller process: a link whose Replies are checked action by action.
class RemotePort : public hal::node::exchange::ControllerPort {
 public:
  /// @param before_begin  called with the time of each Step before it is sent.
  RemotePort(std::unique_ptr<exchange::ControllerLink> link,
             const hal::node::exchange::Hello& hello, const hal::node::exchange::Session& session,
             std::function<void(hal::Time)> before_begin);

  const std::string& name() const override { return summary_.name; }
  hal::Result<void> begin(const hal::node::exchange::Step& step) override;
  hal::Result<hal::node::exchange::Reply> finish() override;
  hal::Result<std::optional<hal::node::exchange::Reply>> try_finish() override;
  bool shares_time() const override { return link_ && link_->shares_time(); }
  std::vector<int> descriptors() const override;
  hal::Result<void> check_alive() override;

  /// Descriptor that wakes up poll() when the process dies; -1 if it runs on another host.
  int death_descriptor() const { return link_ ? link_->death_descriptor() : -1; }

  ProcessSummary summary() const;

  /// Separates the port from the server, which may end before the host that holds this port. Every
  /// later exchange fails.
  void disconnect();

 private:
  hal::node::exchange::Reply checked(hal::node::exchange::Reply reply);
  bool is_good(const hal::node::exchange::Action& action);

  std::unique_ptr<exchange::ControllerLink> link_;  ///< Null after disconnect().
  std::vector<hal::node::exchange::AgentSession> granted_;
  std::function<void(hal::Time)> before_begin_;
  std::string who_;                  ///< Name for messages.
  std::vector<hal::AgentId> asked_;  ///< Agents of the events of the current Step.
  hal::Time step_time_{};            ///< Time of its first event.
  ProcessSummary summary_;
};

}  // namespace gateway::server
