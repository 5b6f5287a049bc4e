#pragma once

#include <sys/types.h>

#include <cstdint>
#include <map>
#include <string>

#include "programs/netns/descriptor.h"

namespace programs::lockstep {

/// What the kernel says of a thread.
enum class KernelState : std::uint8_t {
  kAwake,    ///< It runs, may run, or waits for a disk or a debugger: it will go on by itself.
  kAsleep,   ///< It waits for something that others have to do.
  kStopped,  ///< By a signal (SIGSTOP, a terminal's), until another one makes it go on.
  kGone,     ///< It has ended.
};

/// One thread of an agent, looked at from outside by the files of /proc. One thread.
///
/// `wchan` names the function in which a thread waits only while it is off the run queue and not
/// being woken, so it is exact: get_wchan() of kernel/sched/core.c takes the lock under which
/// threads are woken. It says 0 of a thread that is awake, and since Linux 6.12 also of one that
/// has gone to sleep and is still on the queue; `syscall`, which waits until the thread is off its
/// processor, ends that. `stat` alone is not exact: it says S of a thread that has set its state
/// and still runs.
class KernelThread {
 public:
  KernelThread() = default;  ///< Of no thread: kGone.
  /// @param process, thread  numbers outside.
  KernelThread(pid_t process, pid_t thread);

  KernelState look() const;

  pid_t process() const { return process_; }
  pid_t thread() const { return thread_; }

  /// For messages: the program's name, and the call that it is in: "python3", "futex (wchan
  /// futex_wait_queue)".
  std::string name() const;
  std::string call() const;
  /// Whose debugger has stopped it: "gdb (process 4711)"; empty: none has.
  std::string debugger() const;

 private:
  std::string file(const char* name) const;

  pid_t process_ = -1, thread_ = -1;
  netns::FileDescriptor wchan_, stat_, syscall_;
};

/// Finds the threads of an agent, whose programs know them by numbers of their own. Since
/// Linux 6.11 the kernel translates numbers (ioctl_nsfs(2)); with an older one all of /proc is
/// searched once for each process.
class AgentTasks {
 public:
  /// @param processes  the agent's namespace of process numbers.
  explicit AgentTasks(netns::FileDescriptor processes);

  /// @param process, thread  numbers inside. @return of no thread: it has ended.
  KernelThread find(pid_t process, pid_t thread);

  /// Number outside; 0: it has ended.
  pid_t outside(pid_t process);

  /// Whether none of its threads is left, by its number inside.
  bool has_ended(pid_t process);

  void forget(pid_t process) { outside_.erase(process); }

 private:
  pid_t searched(pid_t process) const;
  pid_t thread_outside(pid_t process, pid_t thread) const;

  netns::FileDescriptor processes_;
  bool translates_;                 ///< The kernel does.
  std::map<pid_t, pid_t> outside_;  ///< What was searched.
};

}  // namespace programs::lockstep
