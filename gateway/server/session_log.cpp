#include "gateway/server/session_log.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

namespace gateway::server {

void log(hal::log::Level level, hal::Time at, const std::string& text) {
  hal::log::write(level, at, "gateway", text);
}

void log_hello(const hal::node::exchange::Hello& hello, hal::Time at) {
  if (!hal::log::is_on(hal::log::Level::kDebug)) return;
  log(hal::log::Level::kDebug, at,
      fmt::format("Hello of process '{}' (pid {}) for {}", hello.process, hello.pid,
                  fmt::join(hello.patterns, ", ")));
}

void log_session(const hal::node::exchange::Hello& hello,
                 const hal::node::exchange::Session& session) {
  if (!hal::log::is_on(hal::log::Level::kDebug)) return;
  std::vector<std::string> names;
  names.reserve(session.agents.size());
  for (const auto& agent : session.agents) names.push_back(agent.name);
  log(hal::log::Level::kDebug, hal::Time{},
      fmt::format("session: process '{}' (pid {} on {}, program {}) drives {}", hello.process,
                  hello.pid, hello.host, hello.program, fmt::join(names, ", ")));
}

}  // namespace gateway::server
