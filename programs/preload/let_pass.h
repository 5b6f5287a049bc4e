#pragma once

namespace programs::preload {

/// In a library that catches the system calls of its process (programs/waits/net.h, which defines
/// it): while this lives, those of the calling thread go to the kernel.
class LetPass {
 public:
  LetPass();
  ~LetPass();
  LetPass(const LetPass&) = delete;
  LetPass& operator=(const LetPass&) = delete;

 private:
  char before_;
};

/// What calls the next library's function and lets its system calls pass.
template <class Result, class... Parameters>
auto passing(Result (*function)(Parameters...)) {
  return [function](Parameters... given) {
    const LetPass let_pass;
    return function(given...);
  };
}
template <class Result, class... Parameters>
auto passing(Result (*function)(Parameters..., ...)) {
  return [function](Parameters... given, auto... more) {
    const LetPass let_pass;
    return function(given..., more...);
  };
}

}  // namespace programs::preload
