#pragma once

#include <sys/types.h>

namespace programs::netns {

/// The terminal of this process, if it has one and is in its foreground. A program inside an agent
/// gets it as a shell gives it to a job, because process groups from outside have no ids inside.
class Terminal {
 public:
  Terminal();
  ~Terminal() { take_back(); }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  /// Call in a new child: makes it a process group of its own, in the foreground.
  void take() const;
  /// Call in the parent. @param child  its pid in this process's namespace.
  void give_to(pid_t child) const;
  void take_back() const;

 private:
  bool is_ours_;
};

}  // namespace programs::netns
