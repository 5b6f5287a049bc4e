#include "programs/models/xacro.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>

namespace programs::models {
namespace {

/// With spaces for comments, so that lines stay the same.
std::string without_comments(std::string text) {
  for (std::size_t at = text.find("<!--"); at != std::string::npos; at = text.find("<!--", at)) {
    const std::size_t end = std::min(text.find("-->", at), text.size());
    for (; at < end; ++at)
      if (text[at] != '\n') text[at] = ' ';
  }
  return text;
}

}  // namespace

std::optional<Line> first_of_xacro(const std::string& given) {
  const std::string text = without_comments(given);
  const std::size_t at = text.find("<xacro:");
  if (at == std::string::npos) return std::nullopt;
  const auto before = text.begin() + static_cast<std::ptrdiff_t>(at);
  return 1 + static_cast<Line>(std::count(text.begin(), before, '\n'));
}

std::string expanded_by_xacro(const std::filesystem::path& file, Line line) {
  std::array<int, 2> pipe{};
  if (pipe2(pipe.data(), O_CLOEXEC) != 0) throw ModelError(line, "cannot make a pipe for xacro");
  posix_spawn_file_actions_t actions{};
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, pipe[1], STDOUT_FILENO);
  std::string program = "xacro", name = file.string();
  std::array<char*, 3> words{program.data(), name.data(), nullptr};
  pid_t child = 0;
  const int failed = posix_spawnp(&child, "xacro", &actions, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(pipe[1]);
  std::string text;
  std::array<char, 4096> block{};
  for (ssize_t got = 0; failed == 0 && (got = read(pipe[0], block.data(), block.size())) > 0;)
    text.append(block.data(), static_cast<std::size_t>(got));
  close(pipe[0]);
  if (failed != 0)
    throw ModelError(line,
                     "has elements of xacro, and the program xacro is not in PATH: it is part of "
                     "ROS (ros-DISTRIBUTION-xacro); or give the file that it makes of this one");
  int status = 0;
  waitpid(child, &status, 0);
  if (status != 0) throw ModelError(line, "xacro could not expand it: `xacro FILE` says why");
  return text;
}

}  // namespace programs::models
