#include "baraka/main/controllers_option.h"

#include <CLI/CLI.hpp>
#include <map>

#include "gateway/process/command_line.h"

namespace baraka::main {

using run::controllers::ControllersFrom;

void add_controllers(CLI::App& command, ControllersFrom& controllers, const std::string& of_what) {
  const std::map<std::string, ControllersFrom> from{{"spawn", ControllersFrom::kSpawn},
                                                    {"external", ControllersFrom::kExternal},
                                                    {"in-process", ControllersFrom::kInProcess}};
  command
      .add_option_function<std::string>(
          "--controllers",
          [&controllers, from](const std::string& how) { controllers = from.at(how); },
          of_what + "spawn: start them (default); external: wait for them; in-process: load them")
      ->transform(gateway::process::one_of({"spawn", "external", "in-process"}));
}

}  // namespace baraka::main
