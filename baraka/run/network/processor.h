#pragma once

#include <sched.h>

#include "programs/netns/descriptor.h"

namespace baraka::run::network {

/// One of the processors that this process may use, for a run in lock-step. The thread of the run
/// and its programs take turns. On two processors, one would have to be woken for each turn, which
/// takes longer than most turns. Runs choose different processors while there are any. One thread.
class Processor {
 public:
  Processor();

  /// Whether other runs use it, too: there were none left.
  bool is_shared() const { return !reserved_.is_open(); }

  /// While this lives, the calling thread, and processes and threads that it starts, run on the
  /// processor only. Later, these still do.
  class Use {
   public:
    explicit Use(const Processor& processor);
    ~Use();
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;

   private:
    cpu_set_t before_{};
  };

 private:
  int number_ = 0;
  programs::netns::FileDescriptor reserved_;  ///< Others do not choose it while this is open.
};

}  // namespace baraka::run::network
