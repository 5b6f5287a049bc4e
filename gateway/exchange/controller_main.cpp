#include <fmt/core.h>

#include <exception>
#include <string>

#include "gateway/exchange/controller_process.h"
#include "gateway/guard/trust.h"
#include "gateway/process/domains.h"
#include "gateway/process/standard_output.h"
#include "hal/types/printable.h"
#include "hal/types/terminal_colours.h"

namespace {

void complain(const char* program, const std::string& what) {
  hal::print_line(hal::Tone::kMistake, fmt::format("{}: {}", program, what));
}

}  // namespace

/// The main program of every controller: controllers/<name> defines baraka_controller() and is
/// linked with this file.
int main(int argc, char** argv) {
  try {
    const hal::ControllerKind& kind = *baraka_controller();
    const auto parsed = gateway::runtime::parse_controller_options(argc, argv, kind);
    if (!parsed.options) return gateway::process::with_output_written(parsed.exit_status);
    return static_cast<int>(gateway::exchange::run_controllers(kind, *parsed.options));
  } catch (const gateway::process::NoSuchDomain& error) {
    complain(argv[0], hal::printable(error.what()));
    return 2;  // as for a wrong option
  } catch (const gateway::guard::NoSuchUser& error) {
    complain(argv[0], hal::printable(error.what()));
    return 2;
  } catch (const std::exception& error) {
    complain(argv[0], hal::printable_lines(error.what()));
    return 1;
  }
}
