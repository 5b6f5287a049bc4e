#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <utility>

#include "gateway/inside_starter.h"
#include "gateway/run/network_of_run.h"

namespace gateway {

/// Starts controllers in the namespaces of a run. They end with these.
class StartInside final : public InsideStarter {
 public:
  /// @param network  outlives it.
  explicit StartInside(NetworkOfRun& network) : network_(network) {}

  void start(hal::AgentId agent, const InsideProgram& program) override;
  hal::Result<void> check() override;

 private:
  NetworkOfRun& network_;
  /// By index of their agent and number among its programs: name and log.
  std::map<std::pair<std::size_t, std::uint32_t>, std::pair<std::string, std::filesystem::path>>
      started_;
};

}  // namespace gateway
