#include "python/bindings/errors.h"

#include <array>
#include <stdexcept>

namespace python::bindings {
namespace {

namespace py = pybind11;

/// By hal::Errc. Never freed: Python may end before this library does.
std::array<PyObject*, 6>& classes() {
  static std::array<PyObject*, 6> all{};
  return all;
}
PyObject*& call_error() {
  static PyObject* one = nullptr;
  return one;
}

/// A new class of exceptions in the module. @param bases  a class or a tuple of classes.
PyObject* add_class(py::module_& module, const char* name, const py::object& bases,
                    const char* meaning) {
  const std::string full = std::string("baraka.") + name;
  PyObject* const made = PyErr_NewExceptionWithDoc(full.c_str(), meaning, bases.ptr(), nullptr);
  if (made == nullptr) throw py::error_already_set();
  module.attr(name) = py::reinterpret_borrow<py::object>(made);
  return made;
}

py::object also(const py::object& base, PyObject* builtin) {
  return py::make_tuple(base, py::reinterpret_borrow<py::object>(builtin));
}

}  // namespace

void refuse(const std::string& what) {
  throw HalError(hal::Error{hal::Errc::kInvalidArgument, what});
}

void add_errors(py::module_& module) {
  const auto base = py::reinterpret_steal<py::object>(
      add_class(module, "Error", py::reinterpret_borrow<py::object>(PyExc_Exception),
                "Why a call of the HAL failed."));
  Py_INCREF(base.ptr());
  classes() = {
      add_class(module, "InvalidArgument", also(base, PyExc_ValueError),
                "A documented precondition does not hold. Fix the caller."),
      add_class(module, "NotAvailable", base,
                "The agent has no such sensor, or no reading of it that is recent enough."),
      add_class(module, "NotConnected", base, "The peer process has ended."),
      add_class(module, "Timeout", base, "The peer process is alive but did not answer in time."),
      add_class(module, "ProtocolError", base, "The peer process violated the protocol."),
      add_class(module, "ControllerFailed", base, "A controller threw an exception."),
  };
  call_error() = add_class(module, "CallError", also(base, PyExc_RuntimeError),
                           "A call outside a callback, from another thread, or after the end.");
  // NOLINTNEXTLINE(performance-unnecessary-value-param): pybind11 says so
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const HalError& error) {
      PyErr_SetString(classes().at(static_cast<std::size_t>(error.code)), error.what());
    } catch (const std::logic_error& error) {  // of CallGuard
      PyErr_SetString(call_error(), error.what());
    }
  });
}

}  // namespace python::bindings
