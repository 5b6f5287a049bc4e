#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <utility>

#include "baraka/run/network/network_of_run.h"
#include "gateway/server/inside_starter.h"

namespace baraka::run::network {

/// Starts controllers in the network namespaces of a run. They end with the namespaces.
class NamespaceStarter final : public gateway::server::InsideStarter {
 public:
  /// @param network  must outlive this object.
  explicit NamespaceStarter(NetworkOfRun& network) : network_(network) {}

  void start(hal::AgentId agent, const gateway::server::InsideProgram& program) override;
  bool holds() const override { return network_.holds_programs(); }
  void give_turns(hal::AgentId agent, hal::Time now,
                  const std::function<bool()>& may_go_on) override {
    network_.give_turns(agent, now, may_go_on);
  }
  hal::Result<void> check() override;

 private:
  NetworkOfRun& network_;
  /// Name and log file by index of the agent and number among its programs.
  std::map<std::pair<std::size_t, std::uint32_t>, std::pair<std::string, std::filesystem::path>>
      started_;
};

}  // namespace baraka::run::network
