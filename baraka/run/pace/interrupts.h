#pragma once

namespace baraka::run::pace {

/// From now on the first SIGINT, SIGTERM or (unless ignored) SIGHUP only sets a flag; the next one
/// ends the process.
void catch_interrupts();
bool interrupted();

}  // namespace baraka::run::pace
