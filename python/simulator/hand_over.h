#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "hal/types/geometry.h"
#include "python/simulator/episode.h"

namespace python::simulator {

/// Where the thread of a run and its user meet: one of the two works at a time.
class HandOver {
 public:
  /// On the run's thread: shows a situation and waits for the answer. nullopt: the run is to end.
  std::optional<std::vector<hal::Twist2>> ask(Situation situation) {
    std::unique_lock lock(mutex_);
    situation_ = std::move(situation);
    changed_.notify_all();
    changed_.wait(lock, [this] { return answer_.has_value() || closed_; });
    if (closed_) return std::nullopt;
    return std::exchange(answer_, std::nullopt);
  }
  /// On the run's thread: the last situation, or what has failed.
  void finish(Situation situation, std::string error) {
    const std::lock_guard lock(mutex_);
    situation_ = std::move(situation);
    error_ = std::move(error);
    changed_.notify_all();
  }

  /// On the user's thread.
  void answer(std::vector<hal::Twist2> drives) {
    const std::lock_guard lock(mutex_);
    answer_ = std::move(drives);
    changed_.notify_all();
  }
  /// The next situation. @throws std::runtime_error  the run failed, or was closed.
  Situation next() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return situation_.has_value() || closed_; });
    if (closed_) throw std::runtime_error("the episode has been closed");
    if (!error_.empty()) throw std::runtime_error(error_);
    return *std::exchange(situation_, std::nullopt);
  }
  /// On any thread.
  void close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    changed_.notify_all();
  }
  bool is_closed() {
    const std::lock_guard lock(mutex_);
    return closed_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Situation> situation_;
  std::optional<std::vector<hal::Twist2>> answer_;
  std::string error_;
  bool closed_ = false;
};

}  // namespace python::simulator
