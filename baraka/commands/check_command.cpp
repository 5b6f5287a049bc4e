#include "baraka/commands/check_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "baraka/commands/file_kinds.h"
#include "baraka/commands/wrong_kind.h"
#include "gateway/process/exit_status.h"
#include "hal/files/config/errors.h"
#include "hal/files/config/shared_folders.h"
#include "hal/types/terminal_colours.h"

namespace baraka::commands {
namespace {

/// The kind of file with that name; null: there is none.
const FileKind* kind_named(const std::string& name) {
  const auto& kinds = file_kinds();
  const auto found = std::find_if(kinds.begin(), kinds.end(),
                                  [&](const FileKind& kind) { return kind.name == name; });
  return found == kinds.end() ? nullptr : &*found;
}

}  // namespace

int check(const CheckOptions& options) {
  const FileKind* const wanted = kind_named(options.kind);
  int status = gateway::process::kDone;
  for (const std::string& file : options.files) {
    try {
      const std::string path = hal::files::config::named_file(
          file, {"scenarios", "campaigns", "fleets", "robots", "radios", "hardware"});
      const FileKind& kind = wanted != nullptr ? *wanted : recognised(path, options.overrides);
      with_includes_of(kind.name, path, options.overrides, [&] {
        kind.check(path, options.overrides, options.mode);
        return gateway::process::kDone;
      });
      fmt::print("{}: ok\n", file);
    } catch (const hal::files::config::ConfigErrors& errors) {
      std::fflush(stdout);
      hal::print_line(hal::Tone::kMistake, errors.what());
      status = gateway::process::kUsage;
    }
  }
  return status;
}

}  // namespace baraka::commands
