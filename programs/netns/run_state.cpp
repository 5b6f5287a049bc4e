#include "programs/netns/run_state.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <sstream>

#include "programs/netns/namespaces.h"

namespace programs::netns {
namespace {

constexpr std::string_view kHolder = "baraka-holder";

std::string first_line(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

/// Whether a process, given by its folder in /proc, is the holder of a run of this user.
bool is_holder_of_user(const std::filesystem::path& process) {
  struct stat status {};
  return stat(process.c_str(), &status) == 0 && status.st_uid == geteuid() &&
         first_line(process / "comm") == kHolder;
}

void read_line(RunState& state, const std::string& key, std::istringstream& rest) {
  if (key == "init") rest >> state.init.number >> state.init.started;
  if (key == "dilation") std::getline(rest >> std::ws, state.dilation);
  if (key == "library") std::getline(rest >> std::ws, state.library);
  if (key != "agent") return;
  RunState::Agent agent;
  rest >> agent.users >> agent.processes >> agent.network >> agent.mount >> agent.host >> agent.ipc;
  std::getline(rest >> std::ws, agent.name);
  state.agents.push_back(std::move(agent));
}

[[noreturn]] void fail_of_no_run(const std::filesystem::path& folder) {
  throw std::runtime_error(
      fmt::format("{}: no run with programs on the air is under way there", folder.string()));
}

/// The file names a library to load and processes to follow, so its author decides what is
/// executed.
void require_trusted(const std::filesystem::path& path, const struct stat& status) {
  const char* why = nullptr;
  if (!S_ISREG(status.st_mode)) why = "is no file";
  if (geteuid() != 0 && status.st_uid != geteuid()) why = "belongs to another user";
  if ((status.st_mode & (S_IWGRP | S_IWOTH)) != 0) why = "may be written by others";
  if (why != nullptr) {
    throw std::runtime_error(fmt::format("{} {}: it is not trusted", path.string(), why));
  }
}

std::string content_of(const FileDescriptor& file) {
  constexpr std::size_t kLongestState = 1 << 20;
  std::string content;
  std::array<char, 4096> part{};
  ssize_t length = 0;
  while (content.size() < kLongestState &&
         (length = read(file.get(), part.data(), part.size())) > 0) {
    content.append(part.data(), static_cast<std::size_t>(length));
  }
  return content;
}

/// Whether a regular file of this user exists.
bool is_of_user(const std::filesystem::path& file) {
  struct stat status {};
  return lstat(file.c_str(), &status) == 0 && S_ISREG(status.st_mode) && status.st_uid == geteuid();
}

}  // namespace

Process Process::of(pid_t number) {
  // Format: pid (name) state ppid …; the name may contain anything, so count the fields after it.
  const std::string line = first_line(fmt::format("/proc/{}/stat", number));
  const std::size_t behind = line.rfind(')');
  if (behind == std::string::npos) return {number, 0};
  std::istringstream fields(line.substr(behind + 1));
  constexpr int kFieldOfState = 3, kFieldOfStart = 22;
  std::string field;
  for (int i = kFieldOfState; i <= kFieldOfStart; ++i) {
    fields >> field;
    if (i == kFieldOfState && field == "Z") return {number, 0};
  }
  Process process{number, 0};
  std::from_chars(field.data(), field.data() + field.size(), process.started);
  return process;
}

void RunState::write(const FileDescriptor& folder) const {
  std::string text = fmt::format("init {} {}\ndilation {}\nlibrary {}\n", init.number, init.started,
                                 dilation, library);
  for (const Agent& agent : agents) {
    text += fmt::format("agent {} {} {} {} {} {} {}\n", agent.users, agent.processes, agent.network,
                        agent.mount, agent.host, agent.ipc, agent.name);
  }
  unlinkat(folder.get(), kStateFile, 0);
  const FileDescriptor file(
      openat(folder.get(), kStateFile, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644));
  if (!file.is_open() ||
      ::write(file.get(), text.data(), text.size()) != static_cast<ssize_t>(text.size())) {
    fail(fmt::format("{} in the results folder", kStateFile));
  }
}

RunState RunState::read(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / kStateFile;
  // Does not wait for a named pipe, nor follow a link.
  const FileDescriptor file(open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat status {};
  if (!file.is_open() && errno == ENOENT) fail_of_no_run(folder);
  if (!file.is_open() || fstat(file.get(), &status) != 0) fail(path.string());
  require_trusted(path, status);
  RunState state;
  std::istringstream in(content_of(file));
  for (std::string line; std::getline(in, line);) {
    std::istringstream rest(line);
    std::string key;
    rest >> key;
    read_line(state, key, rest);
  }
  if (state.agents.empty() || !state.init.is_alive()) fail_of_no_run(folder);
  struct stat init {};
  if (stat(fmt::format("/proc/{}", state.init.number).c_str(), &init) != 0) fail_of_no_run(folder);
  if (init.st_uid != status.st_uid) {
    throw std::runtime_error(
        fmt::format("{} belongs to user {}, but the process that it names to user {}",
                    path.string(), status.st_uid, init.st_uid));
  }
  state.user = init.st_uid;
  state.group = init.st_gid;
  return state;
}

std::vector<std::filesystem::path> running_runs() {
  std::vector<std::filesystem::path> folders;
  for (const auto& process : std::filesystem::directory_iterator("/proc")) {
    std::error_code error;
    if (!is_holder_of_user(process.path())) continue;
    // Its working folder, by its present name.
    const auto folder = std::filesystem::read_symlink(process.path() / "cwd", error);
    if (!error && is_of_user(folder / kStateFile)) folders.push_back(folder);
  }
  std::ranges::sort(folders);
  return folders;
}

}  // namespace programs::netns
