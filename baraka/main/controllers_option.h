#pragma once

#include <string>

#include "baraka/run/controllers/controllers_of_run.h"

namespace CLI {
class App;
}

namespace baraka::main {

/// Adds --controllers. @param of_what  text before the description of each choice.
void add_controllers(CLI::App& command, run::controllers::ControllersFrom& controllers,
                     const std::string& of_what);

}  // namespace baraka::main
