#pragma once

#include <memory>
#include <optional>
#include <string>

#include "gateway/exchange/controller_link.h"

namespace gateway::exchange {

/// The server's end of the exchange with one controller process: topics baraka/<process>/step and
/// baraka/<process>/reply. Made by Server::link, which must outlive it. One thread at a time.
///
///   begin ──▶ under way ──▶ finish: reply, death or timeout, whichever comes first
///                 │ ▲
///                 └─┘ no reply for kResendAfter: the same Step is written again; the process
///                     answers a Step it has seen from its memory
class ProcessLink final : public ControllerLink {
 public:
  ~ProcessLink() override;

  const std::string& name() const override;
  /// On the wire Steps are numbered 1, 2, 3, … whatever their own numbers are; the Reply has the
  /// number of the Step given here.
  hal::Result<void> begin(const hal::node::exchange::Step& step) override;
  hal::Result<hal::node::exchange::Reply> finish() override;
  hal::Result<std::optional<hal::node::exchange::Reply>> try_finish() override;
  std::vector<int> descriptors() const override;
  hal::Result<void> check_alive() override;

  const DroppedReplies& dropped() const override;
  int death_descriptor() const override;

 private:
  friend class Server;
  class Implementation;
  explicit ProcessLink(std::unique_ptr<Implementation> implementation);
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace gateway::exchange
