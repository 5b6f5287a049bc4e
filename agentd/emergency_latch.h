#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace agentd {

/// Where daemons keep what must outlive them: the folder that a service manager keeps for it
/// (STATE_DIRECTORY, systemd.exec(5)), else baraka in XDG_STATE_HOME, else ~/.local/state/baraka
/// (XDG Base Directory Specification 0.8). @throws UsageError  if the environment names none.
std::filesystem::path default_state_folder();

/// Remembers the emergency stop of an agent over a restart of its daemon, and of the computer: a
/// file in a folder.
class EmergencyLatch {
 public:
  /// Remembers nothing.
  EmergencyLatch() = default;
  /// Makes the folder. @throws UsageError  if nothing can be written there: a stop would be
  ///   forgotten in silence.
  EmergencyLatch(const std::string& agent, const std::filesystem::path& folder);

  bool is_set() const;
  /// Any thread. Failures are logged: the wheels come first.
  void set(bool stopped) const;

  /// Empty: nothing is remembered.
  const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
};

}  // namespace agentd
