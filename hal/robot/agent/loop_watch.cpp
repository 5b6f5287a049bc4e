#include "hal/robot/agent/loop_watch.h"

namespace hal::robot::agent {
namespace {

constexpr int kLooksPerLimit = 4;

}  // namespace

LoopWatch::LoopWatch(platform::EventLoop& loop, drivers::WheelDriver& wheels, Duration limit)
    : loop_(loop), wheels_(wheels), limit_(limit) {
  beat();
  thread_ = std::thread([this] { watch(); });
}

LoopWatch::~LoopWatch() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  end_.notify_one();
  thread_.join();
  loop_.cancel(timer_);
}

void LoopWatch::beat() {
  ++beats_;
  timer_ = loop_.schedule(loop_.now() + limit_ / kLooksPerLimit, [this] { beat(); });
}

void LoopWatch::watch() {
  std::uint64_t seen = beats_;
  int silent = 0;
  std::unique_lock lock(mutex_);
  while (!end_.wait_for(lock, limit_ / kLooksPerLimit, [this] { return ending_; })) {
    const std::uint64_t beats = beats_;
    silent = beats == seen ? silent + 1 : 0;
    seen = beats;
    if (silent < kLooksPerLimit) continue;
    wheels_.stop();
    if (silent == kLooksPerLimit) ++hangs_;
  }
}

}  // namespace hal::robot::agent
