#pragma once

namespace programs::netns {

/// How time passes for the programs of a run.
struct ProgramTime {
  bool is_held = false;  ///< In lock-step: it is the run's virtual time.
  double factor = 1;     ///< Else: its speed relative to wall time, 0.01 .. 1.

  /// Whether a program without the preloaded library would live in another time than the run.
  bool needs_library() const { return is_held || factor != 1; }
};

}  // namespace programs::netns
