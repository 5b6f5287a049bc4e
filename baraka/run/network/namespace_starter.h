#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <utility>

#include "baraka/run/network/network_of_run.h"
#include "gateway/server/inside_starter.h"

namespace baraka::run::network {

/// Starts controllers in the namespaces of a run. They end with these.
class NamespaceStarter final : public gateway::server::InsideStarter {
 public:
  /// @param network  outlives it.
  explicit NamespaceStarter(NetworkOfRun& network) : network_(network) {}

  void start(hal::AgentId agent, const gateway::server::InsideProgram& program) override;
  hal::Result<void> check() override;

 private:
  NetworkOfRun& network_;
  /// By index of their agent and number among its programs: name and log.
  std::map<std::pair<std::size_t, std::uint32_t>, std::pair<std::string, std::filesystem::path>>
      started_;
};

}  // namespace baraka::run::network
