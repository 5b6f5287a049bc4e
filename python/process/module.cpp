#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "gateway/exchange/controller_process.h"
#include "gateway/runtime/controller_options.h"

namespace {

namespace py = pybind11;

/// Runs controllers of one kind in this process, as the main program of a controller in C++ does.
/// @param kind  of kind_of() in _hal.
/// @param arguments  of the command line, with the name of the program.
/// @return the exit status.
int run(const py::capsule& kind, const std::vector<std::string>& arguments) {
  const auto* const controller = kind.get_pointer<const hal::ControllerKind>();
  std::vector<const char*> words;
  words.reserve(arguments.size() + 1);
  for (const std::string& one : arguments) words.push_back(one.c_str());
  words.push_back(nullptr);
  const auto parsed = gateway::runtime::parse_controller_options(static_cast<int>(arguments.size()),
                                                                 words.data(), *controller);
  if (!parsed.options) return parsed.exit_status;
  const py::gil_scoped_release others_may_run;
  return static_cast<int>(gateway::exchange::run_controllers(*controller, *parsed.options));
}

}  // namespace

/// Controllers over DDS, for python/baraka.
PYBIND11_MODULE(_process, module) {
  module.doc() = "Runs controllers as a process that talks DDS.";
  module.def("run", run, py::arg("kind"), py::arg("arguments"));
}
