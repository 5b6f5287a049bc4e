#pragma once

#include <dlfcn.h>

#include <atomic>

#ifdef BARAKA_CATCHES_SYSTEM_CALLS
#include "programs/preload/let_pass.h"
#endif

namespace programs::preload {

/// A function that is replaced by this library, as the next library has it, normally glibc, in its
/// newest version. Several threads may search for it at the same time; they find the same function.
class Intercepted {
 public:
  constexpr explicit Intercepted(const char* name) : name_(name) {}

  void* find() {
    void* found = found_.load(std::memory_order_relaxed);
    if (found != nullptr) return found;
    found = dlsym(RTLD_NEXT, name_);
    found_.store(found, std::memory_order_relaxed);
    return found;
  }

 private:
  const char* name_;
  std::atomic<void*> found_ = nullptr;
};

/// Calls the original function: BARAKA_NEXT(poll)(descriptors, count, timeout). In a library that
/// catches system calls (let_pass.h), those of the function pass.
#ifdef BARAKA_CATCHES_SYSTEM_CALLS
#define BARAKA_PASSING(effect) \
  ::programs::preload::passing<::programs::preload::LetPass::Effect::effect>
#else
#define BARAKA_PASSING(effect)
#endif
#define BARAKA_NEXT_OF(name, effect)                                                 \
  ([] {                                                                              \
    static constinit ::programs::preload::Intercepted call(#name);                   \
    return BARAKA_PASSING(effect)(reinterpret_cast<decltype(&::name)>(call.find())); \
  }())
#define BARAKA_NEXT(name) BARAKA_NEXT_OF(name, kMayWake)
/// The same of a function that wakes no thread which waits in the kernel (LetPass::Effect::kNone).
#define BARAKA_NEXT_QUIET(name) BARAKA_NEXT_OF(name, kNone)

}  // namespace programs::preload
