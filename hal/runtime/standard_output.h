#pragma once

namespace hal::runtime {

/// The last call of every main(): what was printed may not have been written yet, to a full disk
/// for example. @return `status`; 1 instead of 0, said on standard error, if not all was written.
int with_output_written(int status);

}  // namespace hal::runtime
