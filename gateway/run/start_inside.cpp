#include "gateway/run/start_inside.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <array>
#include <stdexcept>

#include "gateway/spawn.h"
#include "hal/dds/waiting.h"

namespace gateway {

void StartInside::start(hal::AgentId agent, const InsideProgram& program) {
  const auto index = network_.index_of(agent);
  if (!index) throw std::runtime_error("a controller's agent has no network");
  const std::uint32_t number =
      network_.namespaces().start(*index, {.arguments = program.arguments,
                                           .environment = program.environment,
                                           .log = program.log,
                                           .folder = {},
                                           .inherited = program.inherited});
  const std::string name = std::filesystem::path(program.arguments.front()).filename().string();
  started_[{*index, number}] = {name, program.log};
}

hal::Result<void> StartInside::check() {
  const std::array descriptors{network_.namespaces().descriptor()};
  if (!hal::dds::wait_readable(descriptors, hal::Duration::zero())) return {};
  for (const netns::Ended& one : network_.namespaces().take_ended()) {
    const auto found = started_.find({one.agent, one.program});
    if (found == started_.end()) continue;
    const auto& [name, log] = found->second;
    const std::string cause = WIFEXITED(one.status)
                                  ? fmt::format("exited with status {}", WEXITSTATUS(one.status))
                                  : fmt::format("killed by signal {}", WTERMSIG(one.status));
    return hal::fail(hal::Errc::kNotConnected,
                     fmt::format("{} {}{}; see {}", name, cause, last_words(log), log.string()));
  }
  return {};
}

}  // namespace gateway
