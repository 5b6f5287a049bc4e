#include "baraka/run/controllers/controller_path.h"

#include <fmt/format.h>

#include <filesystem>
#include <set>
#include <system_error>

#include "gateway/runtime/plugin.h"
#include "hal/types/printable.h"
#include "hal/types/terminal_colours.h"

namespace baraka::run::controllers {

void warn_of_missing_controller_folders() {
  static std::set<std::filesystem::path> named;
  for (const std::filesystem::path& folder : gateway::runtime::named_controller_folders()) {
    std::error_code unknown;
    if (std::filesystem::is_directory(folder, unknown)) continue;
    if (!named.insert(folder).second) continue;
    hal::print_line(hal::Tone::kWarning,
                    fmt::format("warning: BARAKA_CONTROLLER_PATH: there is no folder {}",
                                hal::printable(folder.string())));
  }
}

}  // namespace baraka::run::controllers
