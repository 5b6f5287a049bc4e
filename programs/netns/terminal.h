#pragma once

#include <sys/types.h>

namespace programs::netns {

/// The terminal of this process, if it has one and is in its foreground: a program inside an agent
/// gets it as a shell gives it to a job, for process groups of outside have no numbers there.
class Terminal {
 public:
  Terminal();
  ~Terminal() { take_back(); }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  /// In a new child: a process group of its own, in the foreground.
  void take() const;
  /// In its parent. @param child  as seen from here.
  void give_to(pid_t child) const;
  void take_back() const;

 private:
  bool is_ours_;
};

}  // namespace programs::netns
