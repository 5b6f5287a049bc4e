#pragma once

#include <sys/types.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "gateway/process/waiting.h"
#include "hal/types/clock.h"
#include "hal/types/result.h"
#include "hal/types/time.h"

namespace gateway::process {

/// A program to start.
struct Command {
  std::filesystem::path program;
  std::vector<std::string> arguments;  ///< Without the program itself.
  int domain = 1;                      ///< Becomes BARAKA_DOMAIN of the program.
  std::filesystem::path log;           ///< Its standard output and error are appended here.
  std::string name = {};               ///< For messages; empty: the program's file name.
};

/// How a process ended.
struct Ending {
  std::string name;  ///< Of the command.
  pid_t pid = 0;
  int status = 0;     ///< Exit status; 128 + signal if a signal killed it.
  std::string cause;  ///< "exited with status 2", "killed by signal 9".
  double user_s = 0;  ///< Processor time, user and system, with waited-for children.
};

/// The last line of a program's output for a message: ": its last line"; empty if there is none.
std::string last_words(const std::filesystem::path& log);

/// Controller processes started by this one. Each has its own process group, so Ctrl-C reaches only
/// this process, and the kernel kills it when the thread that started it ends. One thread.
class Spawner {
 public:
  /// @param clock  for waiting; outlives it.
  explicit Spawner(hal::Clock& clock = wall_clock()) : clock_(clock) {}
  ~Spawner();  ///< Calls stop_all().
  Spawner(const Spawner&) = delete;
  Spawner& operator=(const Spawner&) = delete;

  /// @returns the pid. @throws std::runtime_error  if the program cannot be started.
  pid_t start(const Command& command);

  /// Whether all processes are running. Errors: kNotConnected with the name of the first that
  /// ended, how it ended and its last line.
  hal::Result<void> check() const;

  /// Processes that a signal ended, with their last line of output, one per line.
  /// @param logs  folder that contains their logs now.
  std::vector<std::string> killed(const std::filesystem::path& logs) const;

  /// Descriptor of the process that was started first; it becomes readable when that process has
  /// ended. -1: there is none.
  int descriptor() const { return children_.empty() ? -1 : children_.front().descriptor; }

  /// Asks the running processes to end, without waiting.
  void ask_to_end() const;

  /// Waits for all to end by themselves, up to `timeout`.
  void wait_all(hal::Duration timeout);

  /// Ends the running processes: SIGTERM, after 2 s SIGKILL.
  /// @returns how each process ended, in order of start.
  std::vector<Ending> stop_all();

 private:
  struct Child {
    std::string name;
    std::filesystem::path log;
    pid_t pid = 0;
    int descriptor = -1;
  };
  static std::string end_of(const Child& child, const std::filesystem::path& log);

  hal::Clock& clock_;
  std::vector<Child> children_;
};

}  // namespace gateway::process
