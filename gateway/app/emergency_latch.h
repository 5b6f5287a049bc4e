#pragma once

#include <filesystem>
#include <string>

namespace gateway::app {

/// Remembers the emergency stop of an agent over a restart of its daemon: a file in the folder that
/// the service manager keeps for it, RUNTIME_DIRECTORY of the environment. Without one nothing is
/// remembered.
class EmergencyLatch {
 public:
  explicit EmergencyLatch(const std::string& agent);

  bool is_set() const;
  /// Any thread. Failures are logged: the wheels come first.
  void set(bool stopped) const;

 private:
  std::filesystem::path file_;  ///< Empty: none.
};

}  // namespace gateway::app
