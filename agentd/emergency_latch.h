#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace agentd {

/// Folder for state that must survive a restart: the folder from the service manager
/// (STATE_DIRECTORY, systemd.exec(5)), else baraka in XDG_STATE_HOME, else ~/.local/state/baraka
/// (XDG Base Directory Specification 0.8). @throws UsageError  if the environment names none.
std::filesystem::path default_state_folder();

/// Remembers the emergency stop of an agent over a restart of its daemon and of the computer, by a
/// file in a folder.
class EmergencyLatch {
 public:
  /// Remembers nothing.
  EmergencyLatch() = default;
  /// Makes the folder. @throws UsageError  if it cannot be written: a stop would be forgotten
  /// without notice.
  EmergencyLatch(const std::string& agent, const std::filesystem::path& folder);

  bool is_set() const;
  /// Any thread. Errors are only logged, because stopping the wheels is more important.
  void set(bool stopped) const;

  /// Empty: nothing is remembered.
  const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
};

}  // namespace agentd
