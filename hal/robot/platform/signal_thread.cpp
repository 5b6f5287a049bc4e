#include "hal/robot/platform/signal_thread.h"

#include <utility>

namespace hal::robot::platform {

SignalThread::SignalThread(std::initializer_list<int> signals, std::function<void(int)> handler) {
  loop_.on_signals(signals, std::move(handler));
  thread_ = std::thread([this] { loop_.run(); });
}

SignalThread::~SignalThread() {
  loop_.post([this] { loop_.stop(); });
  thread_.join();
}

}  // namespace hal::robot::platform
