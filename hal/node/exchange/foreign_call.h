#pragma once

#include <optional>
#include <string_view>

#include "hal/types/time.h"

namespace hal::node::exchange {

/// While this lives, its thread is not the host's own: a controller's callback runs on it, or it
/// waits for the answer of a controller's process. Either may never come back; then another thread
/// can seize the call and bring things to an end.
///
///   none ──constructor──▶ under way ──destructor──▶ none
///                             │
///                             └─seize_call()─▶ seized: the destructor does not return
///
/// One at a time in a process; of several, the one that began last is the one that can be seized.
class ForeignCall {
 public:
  /// @param who   "controller of r0", "process 'robots'"; outlives this.  @param what  "step()",
  /// "answer"; of static life.   @param at  time of the event.
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

/// A call that was seized. The texts are the call's own, which stays.
struct SeizedCall {
  std::string_view who;
  std::string_view what;
  Time at{};
};

/// The call that the calling thread is in, of several the one that began last; null: none.
/// Async-signal-safe.
const ForeignCall* call_of_this_thread();

/// Takes the call under way from its thread, which will stand still at the end of it: what that
/// thread could touch belongs to the caller now, for the rest of the process. None: no call is
/// under way. Any thread, also that of the call.
std::optional<SeizedCall> seize_call();

}  // namespace hal::node::exchange
