#pragma once

#include <string>

namespace baraka::commands {

/// What can be observed of a run, and the numbers that every run has: for the terminal, and as the
/// page docs/observables.md.
std::string observables_text();
std::string observables_page();

}  // namespace baraka::commands
