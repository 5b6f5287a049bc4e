#include "gateway/process/status_of_command.h"

#include <cstdio>
#include <exception>
#include <string>
#include <system_error>

#include "gateway/process/exit_status.h"
#include "gateway/process/limits.h"
#include "hal/files/config/errors.h"
#include "hal/types/printable.h"
#include "hal/types/terminal_colours.h"

namespace gateway::process {
namespace {

int failed(ExitStatus status, const std::string& what) {
  hal::print_line(hal::Tone::kMistake, "error: " + hal::printable_lines(what));
  return status;
}

}  // namespace

int status_of_command(const std::function<int()>& command) {
  try {
    return command();
  } catch (const hal::files::config::ConfigErrors& e) {
    hal::print_line(hal::Tone::kMistake, hal::printable_lines(e.what()));
    return kUsage;
  } catch (const UsageError& e) {
    return failed(kUsage, e.what());
  } catch (const Interrupted& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return kInterrupted;
  } catch (const std::system_error& e) {
    const bool is_thread_missing = e.code() == std::errc::resource_unavailable_try_again;
    return failed(kRunFailed, is_thread_missing ? limit_met(e.code().value()) : e.what());
  } catch (const std::exception& e) {
    return failed(kRunFailed, e.what());
  }
}

}  // namespace gateway::process
