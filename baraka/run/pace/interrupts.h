#pragma once

namespace baraka::run::pace {

/// From now on SIGINT, SIGTERM and, unless it was ignored, SIGHUP only set a flag, once; the next
/// one ends the process.
void catch_interrupts();
bool interrupted();

}  // namespace baraka::run::pace
