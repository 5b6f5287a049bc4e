#include "gateway/runtime/call_guard.h"

#include <fmt/core.h>

#include <stdexcept>

namespace gateway::runtime {

CallGuard::Callback::Callback(CallGuard& guard) : guard_(guard) {
  guard_.thread_ = std::this_thread::get_id();
}

CallGuard::Callback::~Callback() { guard_.thread_ = std::thread::id{}; }

void CallGuard::check(const char* call) const {
  const std::thread::id running = thread_;
  if (running == std::this_thread::get_id()) return;
  const char* const mistake = running == std::thread::id{}
                                  ? "called outside a callback of this agent's controller"
                                  : "called from another thread than the callback's";
  throw std::logic_error(fmt::format("{}: {}", call, mistake));
}

}  // namespace gateway::runtime
