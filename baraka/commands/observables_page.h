#pragma once

#include <string>

namespace baraka::commands {

/// The observables of a run, and the numbers that every run has: as text for the terminal, and as
/// the page docs/observables.md.
std::string observables_text();
std::string observables_page();

}  // namespace baraka::commands
