#include "baraka/campaign/program_digests.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

#include "gateway/process/find_program.h"
#include "gateway/runtime/plugin.h"
#include "gateway/runtime/python_file.h"
#include "gateway/server/teleop_port.h"
#include "sim/core/fingerprint.h"

namespace baraka::campaign {
namespace {

namespace fs = std::filesystem;

/// Adds a file to the hash; a file that cannot be read adds nothing, because the run will report
/// it.
void add_file(sim::Hash& hash, const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream read;
  read << in.rdbuf();  // in blocks: programs are large
  const std::string content = std::move(read).str();
  hash.add_bytes(content.data(), content.size());
}

std::string digest_of(const std::string& controller) {
  const auto folders = gateway::runtime::controller_folders();
  sim::Hash hash;
  if (const auto program = gateway::process::find_program(controller, folders))
    add_file(hash, *program);
  for (const fs::path& folder : folders) {
    const bool is_python = gateway::runtime::is_python(controller);
    const fs::path plugin = folder / (is_python ? controller : fmt::format("{}.so", controller));
    std::error_code ignored;
    if (!fs::is_regular_file(plugin, ignored)) continue;
    add_file(hash, plugin);
    break;
  }
  return fmt::format("{} {:016x}", controller, hash.value());
}

}  // namespace

std::set<std::string> controllers_of(const sim::scenario::Scenario& scenario) {
  std::set<std::string> names;
  for (const sim::agents::AgentConfig& agent : scenario.simulation.agents) {
    if (!agent.program.empty() && agent.program != gateway::server::kTeleop)
      names.insert(agent.program);
  }
  return names;
}

std::string program_digests(const std::set<std::string>& controllers,
                            const std::set<fs::path>& files) {
  sim::Hash own;
  add_file(own, "/proc/self/exe");
  std::string all = fmt::format("baraka {:016x}", own.value());
  for (const std::string& controller : controllers) all += ", " + digest_of(controller);
  for (const fs::path& file : files) {
    sim::Hash hash;
    add_file(hash, file);
    all += fmt::format(", {} {:016x}", file.filename().string(), hash.value());
  }
  return all;
}

}  // namespace baraka::campaign
