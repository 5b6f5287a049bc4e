#include "baraka/run/network/namespace_starter.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <array>
#include <stdexcept>

#include "gateway/process/spawn.h"
#include "gateway/process/waiting.h"

namespace baraka::run::network {

void NamespaceStarter::start(hal::AgentId agent, const gateway::server::InsideProgram& program) {
  const auto index = network_.index_of(agent);
  if (!index) throw std::runtime_error("a controller's agent has no network");
  const std::uint32_t number = network_.launch(agent, {.arguments = program.arguments,
                                                       .environment = program.environment,
                                                       .log = program.log,
                                                       .folder = {},
                                                       .inherited = program.inherited});
  const std::filesystem::path file = program.arguments.front();
  started_[{*index, number}] = {program.name.empty() ? file.filename().string() : program.name,
                                program.log};
}

hal::Result<void> NamespaceStarter::check() {
  const std::array descriptors{network_.namespaces().descriptor()};
  if (!gateway::process::wait_readable(descriptors, hal::Duration::zero())) return {};
  for (const programs::netns::Ended& one : network_.namespaces().take_ended()) {
    const auto found = started_.find({one.agent, one.program});
    if (found == started_.end()) continue;
    const auto& [name, log] = found->second;
    const std::string cause = WIFEXITED(one.status)
                                  ? fmt::format("exited with status {}", WEXITSTATUS(one.status))
                                  : fmt::format("killed by signal {}", WTERMSIG(one.status));
    return hal::fail(hal::Errc::kNotConnected,
                     fmt::format("{} {}{}; see {}", name, cause, gateway::process::last_words(log),
                                 log.string()));
  }
  return {};
}

}  // namespace baraka::run::network
