#include "gateway/process/manual.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "gateway/process/command_table.h"

namespace gateway::process {
namespace {

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file);
  out << text << std::flush;
  if (!out) throw std::runtime_error(file.string() + ": cannot be written");
}

void write_pages(const CLI::App& command, const std::string& name,
                 const std::filesystem::path& folder) {
  write_text(folder / (name + ".1"), manual_page(command, name));
  for (const CLI::App* one : commands_shown(command)) {
    write_pages(*one, fmt::format("{}-{}", name, one->get_name()), folder);
  }
}

void write_manual(const CLI::App& app, const std::string& program,
                  const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder / "man1");
  std::filesystem::create_directories(folder / "completions");
  write_pages(app, program, folder / "man1");
  write_text(folder / "completions" / program, bash_completion(app, program));
}

}  // namespace

void add_manual(CLI::App& app, const std::string& program) {
  app.name(program);
  app.add_option_function<std::string>("--write-manual",
                                       [&app, program](const std::string& folder) {
                                         write_manual(app, program, folder);
                                         throw CLI::Success();
                                       })
      ->group("")
      ->trigger_on_parse();
}

}  // namespace gateway::process
