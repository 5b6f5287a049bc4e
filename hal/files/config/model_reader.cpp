#include "hal/files/config/model_reader.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <system_error>

namespace hal::files::config {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProgram = "baraka-sdf";
constexpr std::size_t kMostText = 64UL << 20;  // bytes

/// Both ends of a pipe, closed at the end of its life.
class OutputPipe {
 public:
  OutputPipe() {
    if (pipe2(ends_.data(), O_CLOEXEC) != 0)
      throw std::system_error(errno, std::generic_category(), "pipe");
  }
  ~OutputPipe() {
    close(ends_[0]);
    close_writer();
  }
  OutputPipe(const OutputPipe&) = delete;
  OutputPipe& operator=(const OutputPipe&) = delete;
  int reader() const { return ends_[0]; }
  int writer() const { return ends_[1]; }
  void close_writer() {
    if (ends_[1] >= 0) close(ends_[1]);
    ends_[1] = -1;
  }

 private:
  std::array<int, 2> ends_{-1, -1};
};

/// Takes what there is. @return false: nothing more will come, or it is too much.
bool take(int from, std::string& text) {
  std::array<char, 65536> block{};
  const ssize_t got = read(from, block.data(), block.size());
  if (got <= 0 || text.size() > kMostText) return false;
  text.append(block.data(), static_cast<std::size_t>(got));
  return true;
}

/// Reads both pipes until both have ended.
void drain(const OutputPipe& out, const OutputPipe& err, std::string& printed, std::string& said) {
  std::array<pollfd, 2> open{pollfd{out.reader(), POLLIN, 0}, pollfd{err.reader(), POLLIN, 0}};
  const std::array<std::string*, 2> texts{&printed, &said};
  while (open[0].fd >= 0 || open[1].fd >= 0) {
    const int ready = poll(open.data(), open.size(), -1);
    if (ready < 0 && errno != EINTR) return;
    if (ready <= 0) continue;
    for (std::size_t i = 0; i < open.size(); ++i) {
      const bool is_ready = open[i].fd >= 0 && open[i].revents != 0;
      if (is_ready && !take(open[i].fd, *texts[i])) open[i].fd = -1;
    }
  }
}

pid_t started(const fs::path& program, const std::vector<std::string>& arguments,
              const OutputPipe& out, const OutputPipe& err) {
  std::vector<std::string> words{program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions{};
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, out.writer(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err.writer(), STDERR_FILENO);
  pid_t child = 0;
  const int failed =
      posix_spawn(&child, program.c_str(), &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) throw std::system_error(failed, std::generic_category(), program.string());
  return child;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    if (!line.empty()) lines.push_back(line);
  return lines;
}

}  // namespace

fs::path model_reader() {
  std::error_code error;
  std::vector<fs::path> folders;
  const fs::path self = fs::read_symlink("/proc/self/exe", error).parent_path();
  if (!error) folders = {self, self.parent_path() / "bin"};
  const char* const path = std::getenv("PATH");
  std::istringstream list(path == nullptr ? "" : path);
  for (std::string one; std::getline(list, one, ':');)
    if (!one.empty()) folders.emplace_back(one);
  for (const fs::path& folder : folders)
    if (access((folder / kProgram).c_str(), X_OK) == 0) return folder / kProgram;
  return {};
}

ModelReading read_model(const std::vector<std::string>& arguments) {
  ModelReading reading;
  const fs::path program = model_reader();
  if (program.empty()) return {{}, {kNoModelReader}};
  std::string said;
  int status = 0;
  try {
    OutputPipe out, err;
    const pid_t child = started(program, arguments, out, err);
    out.close_writer();
    err.close_writer();
    drain(out, err, reading.yaml, said);
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
  } catch (const std::system_error& error) {
    return {{}, {fmt::format("baraka-sdf cannot be run: {}", error.what())}};
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return reading;
  reading.mistakes = lines_of(said);
  if (WIFSIGNALED(status))
    reading.mistakes = {
        fmt::format("baraka-sdf ended by a signal: {}", strsignal(WTERMSIG(status)))};
  if (reading.mistakes.empty())
    reading.mistakes = {fmt::format("baraka-sdf ended with status {}", WEXITSTATUS(status))};
  return reading;
}

}  // namespace hal::files::config
