#pragma once

#include <optional>
#include <string_view>

#include "hal/types/time.h"

namespace hal::node::exchange {

/// While it exists, its thread runs foreign code: a controller's callback, or a wait for the answer
/// of a controller's process. Neither may ever return; then another thread can seize the call and
/// end the run.
///
///   none ──constructor──▶ under way ──destructor──▶ none
///                             │
///                             └─seize_call()─▶ seized: the destructor does not return
///
/// There is one call at a time in a process; if several overlap, the latest can be seized.
class ForeignCall {
 public:
  /// @param who   "controller of r0", "process 'robots'"; outlives this.
  /// @param what  "step()", "answer"; of static storage duration.   @param at  time of the event.
  ForeignCall(std::string_view who, std::string_view what, Time at);
  ~ForeignCall();
  ForeignCall(const ForeignCall&) = delete;
  ForeignCall& operator=(const ForeignCall&) = delete;

  std::string_view who() const { return who_; }
  std::string_view what() const { return what_; }
  Time at() const { return at_; }

 private:
  std::string_view who_, what_;
  Time at_;
};

/// A call that was seized. The texts are those of the call, which is never destroyed.
struct SeizedCall {
  std::string_view who;
  std::string_view what;
  Time at{};
};

/// The call that the calling thread is in, the latest if there are several; null: none.
/// Async-signal-safe.
const ForeignCall* call_of_this_thread();

/// Takes the call under way from its thread, which will block at the end of the call: from now on
/// the caller owns everything that thread could touch, for the rest of the process. Nullopt: no
/// call is under way. Any thread, also that of the call.
std::optional<SeizedCall> seize_call();

}  // namespace hal::node::exchange
