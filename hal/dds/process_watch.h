#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace hal::dds {

/// What tells a process from every other one, also from a later one with a recycled pid.
struct ProcessIdentity {
  std::string host;  ///< Name of the machine and number of the pid namespace.
  std::int64_t pid = 0;
  std::uint64_t start_time = 0;  ///< Field 22 of /proc/<pid>/stat (proc(5)), clock ticks.
  bool operator==(const ProcessIdentity&) const = default;
};

ProcessIdentity this_process();

/// Field 22 of /proc/<pid>/stat; nothing if there is no such process, or none that may be looked
/// at.
std::optional<std::uint64_t> start_time_of(std::int64_t pid);

/// Notices the death of another process on this host, and nothing else: a process that a debugger
/// or SIGSTOP has halted is not dead.
class ProcessWatch {
 public:
  explicit ProcessWatch(const ProcessIdentity& watched);
  /// Of the process at the other end of a stream of this host, which says nothing there and has the
  /// only descriptor of it. For one in a pid namespace above this one, where it has no pid.
  /// @param channel  stays the caller's.
  explicit ProcessWatch(int channel);
  ~ProcessWatch();
  ProcessWatch(const ProcessWatch&) = delete;
  ProcessWatch& operator=(const ProcessWatch&) = delete;

  /// Whether the process is on this host; if not, this object knows nothing of its death.
  bool is_local() const { return local_; }
  bool is_dead() const;
  /// Becomes readable when the process dies; -1 if it is already dead or elsewhere.
  int descriptor() const { return descriptor_; }
  /// "killed by signal 9", "exited with status 2", or "is gone" of a process that is not a child
  /// of this one, or not known by its pid. @pre is_dead().
  std::string cause() const;

 private:
  bool local_ = false;
  int descriptor_ = -1;
};

}  // namespace hal::dds
