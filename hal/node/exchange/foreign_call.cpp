#include "hal/node/exchange/foreign_call.h"

#include <unistd.h>

#include <atomic>

namespace hal::node::exchange {
namespace {

std::atomic<ForeignCall*> current{nullptr};
constinit thread_local const ForeignCall* of_this_thread = nullptr;

/// Marks `current` while a call is seized. It is never dereferenced.
ForeignCall* seized() {
  static char place;
  return reinterpret_cast<ForeignCall*>(&place);
}

}  // namespace

ForeignCall::ForeignCall(std::string_view who, std::string_view what, Time at)
    : who_(who), what_(what), at_(at) {
  ForeignCall* before = current.load();
  of_this_thread = this;
  while (before != seized() && !current.compare_exchange_weak(before, this)) continue;
}

ForeignCall::~ForeignCall() {
  if (of_this_thread == this) of_this_thread = nullptr;
  ForeignCall* expected = this;
  if (current.compare_exchange_strong(expected, nullptr)) return;
  while (expected == seized()) pause();
}

std::optional<SeizedCall> seize_call() {
  ForeignCall* call = current.load();
  if (call == nullptr || call == seized()) return std::nullopt;
  // If this succeeds, the call's destructor will not return, so the call stays alive.
  if (!current.compare_exchange_strong(call, seized())) return std::nullopt;
  return SeizedCall{call->who(), call->what(), call->at()};
}

const ForeignCall* call_of_this_thread() { return of_this_thread; }

}  // namespace hal::node::exchange
