#pragma once

namespace programs::preload {

/// In a library that catches the system calls of its process (programs/waits/net.h, which defines
/// it): while this lives, those of the calling thread go to the kernel.
class LetPass {
 public:
  /// What the calls can do to other threads.
  enum class Effect : bool {
    kNone,  ///< Wake none: they only ask, take what comes from outside, or change this process's
            ///< memory.
    kMayWake
  };

  explicit LetPass(Effect effect);
  ~LetPass();
  LetPass(const LetPass&) = delete;
  LetPass& operator=(const LetPass&) = delete;

 private:
  char before_;
};

/// What calls the next library's function and lets its system calls pass.
template <LetPass::Effect kEffect, class Result, class... Parameters>
auto passing(Result (*function)(Parameters...)) {
  return [function](Parameters... given) {
    const LetPass let_pass(kEffect);
    return function(given...);
  };
}
template <LetPass::Effect kEffect, class Result, class... Parameters>
auto passing(Result (*function)(Parameters..., ...)) {
  return [function](Parameters... given, auto... more) {
    const LetPass let_pass(kEffect);
    return function(given..., more...);
  };
}

}  // namespace programs::preload
