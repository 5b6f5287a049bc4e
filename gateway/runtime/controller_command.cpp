#include "gateway/runtime/controller_command.h"

#include "gateway/process/find_program.h"
#include "gateway/runtime/plugin.h"
#include "gateway/runtime/python_file.h"

namespace gateway::runtime {
namespace {

namespace fs = std::filesystem;

/// How the interpreter finds the package: its main file by its place, in a build or installation.
std::vector<std::string> package_words() {
  std::error_code ignored;
  const fs::path self = fs::read_symlink("/proc/self/exe", ignored);
  for (const char* const place : {"python", "../lib/python3/dist-packages"}) {
    const fs::path main = (self.parent_path() / place / "baraka/__main__.py").lexically_normal();
    if (!self.empty() && fs::is_regular_file(main, ignored)) return {main.string()};
  }
  return {"-m", "baraka"};
}

std::vector<std::string> python_command(const std::string& program,
                                        const std::vector<fs::path>& folders) {
  for (const fs::path& folder : folders) {
    const fs::path file = fs::absolute(folder / program).lexically_normal();
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored)) continue;
    std::vector<std::string> words{python_interpreter()};
    for (std::string& one : package_words()) words.push_back(std::move(one));
    words.push_back(file.string());
    return words;
  }
  return {};
}

}  // namespace

std::vector<std::string> controller_command(const std::string& program,
                                            const std::vector<fs::path>& folders) {
  if (is_python(program)) return python_command(program, folders);
  const auto found = process::find_program(program, folders);
  return found ? std::vector<std::string>{found->string()} : std::vector<std::string>{};
}

}  // namespace gateway::runtime
