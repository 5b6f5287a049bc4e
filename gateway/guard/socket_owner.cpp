#include "gateway/guard/socket_owner.h"

#include <fmt/core.h>

#include <charconv>
#include <filesystem>
#include <string>
#include <system_error>

namespace gateway::guard {

// Processes can end while they are inspected: nothing here may throw.

std::optional<bool> has_socket(std::int64_t pid, std::uint64_t inode) {
  const std::string wanted = fmt::format("socket:[{}]", inode);
  std::error_code error;
  std::filesystem::directory_iterator file(fmt::format("/proc/{}/fd", pid), error);
  while (!error && file != std::filesystem::directory_iterator()) {
    std::error_code gone;
    if (std::filesystem::read_symlink(file->path(), gone) == wanted) return true;
    file.increment(error);
  }
  if (error) return std::nullopt;
  return false;
}

std::optional<std::int64_t> process_with(std::uint64_t inode) {
  std::error_code error;
  std::filesystem::directory_iterator process("/proc", error);
  for (; !error && process != std::filesystem::directory_iterator(); process.increment(error)) {
    const std::string name = process->path().filename().string();
    std::int64_t pid = 0;
    const auto [end, fault] = std::from_chars(name.data(), name.data() + name.size(), pid);
    const bool is_process = fault == std::errc{} && end == name.data() + name.size();
    if (is_process && has_socket(pid, inode) == true) return pid;
  }
  return std::nullopt;
}

}  // namespace gateway::guard
