#include <pybind11/pybind11.h>

#include "python/bindings/agent.h"
#include "python/bindings/errors.h"
#include "python/bindings/kind.h"
#include "python/bindings/values.h"

namespace {

namespace py = pybind11;
namespace bindings = python::bindings;

py::capsule kind_capsule(py::handle of_class, py::handle name) {
  const hal::ControllerKind& kind = bindings::kind_of(of_class, bindings::text_from(name, "name"));
  return py::capsule(&kind, bindings::kKindCapsule);
}

}  // namespace

/// What python/baraka is made of.
PYBIND11_MODULE(_hal, module) {
  module.doc() = "The HAL of BARAKA: hal/api for controllers in Python.";
  bindings::add_errors(module);
  module.attr("EVERYONE") = hal::kEveryone.value;
  module.attr("NEIGHBOURS") = hal::kNeighbours.value;
  module.attr("LAST_ADDRESS") = hal::kLastAddress;
  bindings::add_agents(module);
  bindings::add_math(module);
  module.def("kind_of", kind_capsule, py::arg("of_class"), py::arg("name"));
}
