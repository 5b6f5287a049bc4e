#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "hal/types/printable.h"
#include "programs/models/robot_yaml.h"
#include "programs/models/sdf_reader.h"
#include "programs/models/urdf.h"
#include "programs/models/world_yaml.h"

/// baraka-sdf: prints a robot in URDF or SDF, or a world in SDF, as YAML of BARAKA. Messages are
/// "FILE:LINE:1: WHAT" or "drive.KEY: WHAT". Exit status: 0 done, 1 the file or `drive` is wrong,
/// 2 wrong arguments.
namespace {

using namespace programs::models;

constexpr rlim_t kLongest = 60;            // s of processor time
constexpr rlim_t kMostMemory = 4UL << 30;  // bytes
constexpr const char* kUsage =
    "baraka-sdf [--world] [--urdf] [--model NAME] [--drive YAML] [--robot-path DIR]... FILE\n"
    "Prints a robot in URDF or SDF as a robot file of BARAKA.\n"
    "  --drive YAML      names of the wheels' joints: '{left: A, right: B, casters: LINK}'\n"
    "  --model NAME      which model of an SDF file; default: the only one\n"
    "  --robot-path DIR  where package:// and model:// are searched for, before ROS_PACKAGE_PATH,\n"
    "                    AMENT_PREFIX_PATH and GZ_SIM_RESOURCE_PATH\n"
    "  --urdf            the file is URDF, whatever its name\n"
    "  --world           print the models of an SDF world as walls and movables\n";

struct Asked {
  std::string file, model, drive;
  std::vector<std::filesystem::path> folders;
  bool is_world = false, is_urdf = false, is_wrong = false;
};

/// @return false: the word is not an option that takes a value.
bool take_value(const std::string& option, const std::string& value, Asked& asked) {
  if (option == "--model") {
    asked.model = value;
  } else if (option == "--drive") {
    asked.drive = value;
  } else if (option == "--robot-path") {
    asked.folders.emplace_back(value);
  } else {
    return false;
  }
  return true;
}

void take_word(const std::string& word, Asked& asked) {
  if (word == "--world") {
    asked.is_world = true;
  } else if (word == "--urdf") {
    asked.is_urdf = true;
  } else if (word.starts_with("--") || !asked.file.empty()) {
    asked.is_wrong = true;
  } else {
    asked.file = word;
  }
}

Asked asked_of(const std::vector<std::string>& words) {
  Asked asked;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool is_last = i + 1 == words.size();
    if (!is_last && take_value(words[i], words[i + 1], asked)) {
      ++i;
    } else {
      take_word(words[i], asked);
    }
  }
  asked.is_wrong = asked.is_wrong || asked.file.empty();
  return asked;
}

bool is_urdf(const Asked& asked) {
  const std::string name = asked.file;
  return asked.is_urdf || name.ends_with(".urdf") || name.ends_with(".xacro");
}

std::string yaml_of(const Asked& asked) {
  const SearchPath search(asked.file, asked.folders);
  if (asked.is_world) return world_yaml(read_sdf_world(asked.file, search), asked.file);
  const DriveChoice choice = asked.drive.empty() ? DriveChoice{} : parse_drive(asked.drive);
  const Model model =
      is_urdf(asked) ? read_urdf(asked.file, search) : read_sdf(asked.file, asked.model, search);
  return robot_yaml(robot_of(model, choice), asked.file);
}

/// @param messages  where mistakes are told.
int print(const Asked& asked, std::FILE* messages) {
  try {
    const std::string text = yaml_of(asked);
    const bool is_written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
    return is_written && std::fflush(stdout) == 0 ? 0 : 1;
  } catch (const ModelError& error) {
    fmt::print(messages, "{}:{}:1: {}\n", hal::printable(asked.file), std::max(1, error.line()),
               hal::printable(error.what()));
  } catch (const DriveError& error) {
    fmt::print(messages, "{}\n", hal::printable(error.what()));
  } catch (const std::exception& error) {
    fmt::print(messages, "{}:1:1: {}\n", hal::printable(asked.file), hal::printable(error.what()));
  }
  std::fflush(messages);
  return 1;
}

/// Leaves what libraries say to nobody, and gives what was the way to the terminal.
std::FILE* own_messages() {
  const int kept = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 10);
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (kept < 0 || nowhere < 0) return stderr;
  dup2(nowhere, STDERR_FILENO);
  close(nowhere);
  return fdopen(kept, "w");
}

/// What reads the file may end by a signal or never: libraries of others on files of others.
int print_in_a_process(const Asked& asked) {
  const pid_t child = fork();
  if (child < 0) return print(asked, stderr);
  if (child == 0) {
    const rlimit time{kLongest, kLongest};
    setrlimit(RLIMIT_CPU, &time);
#ifndef __SANITIZE_ADDRESS__  // its shadow takes terabytes of addresses
    const rlimit memory{kMostMemory, kMostMemory};
    setrlimit(RLIMIT_AS, &memory);
#endif
    _exit(print(asked, own_messages()));
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status)) return WEXITSTATUS(status);
  fmt::print(stderr, "{}:1:1: the reader of the file ended by a signal: {}\n",
             hal::printable(asked.file), strsignal(WTERMSIG(status)));
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words == std::vector<std::string>{"--help"}) {
    fmt::print("{}", kUsage);
    return 0;
  }
  const Asked asked = asked_of(words);
  if (!asked.is_wrong) return print_in_a_process(asked);
  fmt::print(stderr, "{}", kUsage);
  return 2;
}
