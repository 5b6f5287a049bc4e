#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace gateway::process {

/// Identifies a process uniquely, also after its pid has been reused.
struct ProcessIdentity {
  std::string host;  ///< Name of the machine and number of the pid namespace.
  std::int64_t pid = 0;
  std::uint64_t start_time = 0;  ///< Field 22 of /proc/<pid>/stat (proc(5)), clock ticks.
  bool operator==(const ProcessIdentity&) const = default;
};

ProcessIdentity this_process();

/// Field 22 of /proc/<pid>/stat; nullopt if there is no such process or it is not accessible.
std::optional<std::uint64_t> start_time_of(std::int64_t pid);

/// Detects the death of another process on this host. A process that a debugger or SIGSTOP has
/// stopped is not dead.
class ProcessWatch {
 public:
  explicit ProcessWatch(const ProcessIdentity& watched);
  /// Watches the process at the other end of a stream socket on this host. That process must not
  /// write to it and must have its only descriptor. For a process in a parent pid namespace, which
  /// has no pid here.
  /// @param channel  remains the caller's.
  explicit ProcessWatch(int channel);
  ~ProcessWatch();
  ProcessWatch(const ProcessWatch&) = delete;
  ProcessWatch& operator=(const ProcessWatch&) = delete;

  /// Whether the process is on this host; if not, its death is not detected.
  bool is_local() const { return local_; }
  bool is_dead() const;
  /// Becomes readable when the process dies; -1 if it is already dead or elsewhere.
  int descriptor() const { return descriptor_; }
  /// "killed by signal 9", "exited with status 2", or "is gone" for a process that is not a child
  /// of this one or has no known pid. @pre is_dead().
  std::string cause() const;

 private:
  bool local_ = false;
  int descriptor_ = -1;
};

}  // namespace gateway::process
