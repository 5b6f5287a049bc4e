#pragma once

#include <dlfcn.h>

#include <atomic>

namespace programs::preload {

/// A call as it would be without us: that of the next library that has it, glibc's as a rule, in
/// its newest version. The search is not kept from other threads, which find the same.
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

/// The intercepted call of this name: BARAKA_NEXT(poll)(descriptors, count, timeout).
#define BARAKA_NEXT(name)                                          \
  ([] {                                                            \
    static constinit ::programs::preload::Intercepted call(#name); \
    return reinterpret_cast<decltype(&::name)>(call.find());       \
  }())

}  // namespace programs::preload
