#pragma once

#include <dlfcn.h>

#include <atomic>

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

/// Calls the original function: BARAKA_NEXT(poll)(descriptors, count, timeout).
#define BARAKA_NEXT(name)                                          \
  ([] {                                                            \
    static constinit ::programs::preload::Intercepted call(#name); \
    return reinterpret_cast<decltype(&::name)>(call.find());       \
  }())

}  // namespace programs::preload
