#pragma once

namespace gateway::process {

/// The last call of every main(): flushes standard output, which may fail, for example on a full
/// disk. @return `status`; if output was lost, 1 instead of 0, with a message on standard error.
int with_output_written(int status);

}  // namespace gateway::process
