#include "python/bindings/controller.h"

#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

#include "python/bindings/values.h"

namespace python::bindings {
namespace {

namespace py = pybind11;

py::object base_class() { return py::module_::import("baraka.controller").attr("Controller"); }

/// One of the values of a controller's parameters, as the default's kind says.
py::object python_value(py::handle spec, const hal::Parameters& parameters,
                        const std::string& name) {
  const auto kind = spec.attr("kind").cast<std::string>();
  if (kind == "flag") return py::bool_(parameters.flag(name));
  if (kind == "text") return py::str(parameters.text(name));
  if (kind == "number") return py::float_(parameters[name]);
  py::list all;
  if (kind == "numbers") {
    for (const double one : parameters.numbers(name)) all.append(py::float_(one));
  } else {
    for (const std::string& one : parameters.texts(name)) all.append(py::str(one));
  }
  return all;
}

}  // namespace

std::string report_of(const py::error_already_set& raised) {
  try {
    const py::object report = py::module_::import("baraka.reporting").attr("report");
    const py::object trace = raised.trace() ? py::object(raised.trace()) : py::object(py::none());
    return report(raised.type(), raised.value(), trace).cast<std::string>();
  } catch (const py::error_already_set&) {
    return raised.what();
  }
}

py::object parameters_of(py::handle of_class, const hal::Parameters& parameters) {
  py::dict values;
  py::set given;
  for (const auto& [name, spec] : of_class.attr("parameters").cast<py::dict>()) {
    const auto text = name.cast<std::string>();
    values[name] = python_value(spec, parameters, text);
    if (parameters.is_given(text)) given.add(name);
  }
  return py::module_::import("baraka.controller").attr("Parameters")(values, given);
}

PythonController::PythonController(py::handle of_class, std::shared_ptr<AgentHandle> agent,
                                   const py::object& python_agent,
                                   const hal::Parameters& parameters)
    : agent_(std::move(agent)) {
  try {
    reported([&] {
      self_ = of_class(python_agent, parameters_of(of_class, parameters));
      start_ = method("start");
      step_ = method("step");
      receive_ = method("receive");
      timer_ = method("timer");
      notice_ = method("notice");
      stop_ = method("stop");
    });
  } catch (...) {
    agent_->end();
    throw;
  }
}

PythonController::~PythonController() {  // NOLINT(bugprone-exception-escape): it takes a lock
  const py::gil_scoped_acquire lock;
  agent_->end();
  for (py::object* const one : {&start_, &step_, &receive_, &timer_, &notice_, &stop_, &self_}) {
    *one = py::object();
  }
}

py::object PythonController::method(const char* name) const {
  const py::object own = py::type::of(self_).attr(name);
  if (own.is(base_class().attr(name)) && !py::hasattr(self_.attr("__dict__"), name)) return {};
  return self_.attr(name);
}

void PythonController::start() {
  if (!start_) return;
  const py::gil_scoped_acquire lock;
  reported([this] { start_(); });
}

void PythonController::step() {
  if (!step_) return;
  const py::gil_scoped_acquire lock;
  reported([this] { step_(); });
}

void PythonController::receive(const hal::Message& message) {
  if (!receive_) return;
  const py::gil_scoped_acquire lock;
  reported([&] { receive_(tuple_of(message)); });
}

void PythonController::timer(hal::TimerId id) {
  if (!timer_) return;
  const py::gil_scoped_acquire lock;
  reported([&] { timer_(id); });
}

void PythonController::notice(hal::MessageId id, hal::Fate fate) {
  if (!notice_) return;
  const py::gil_scoped_acquire lock;
  reported([&] {
    static constinit ValueClass fate_class("Fate");
    notice_(id, fate_class(std::string(hal::to_string(fate))));
  });
}

void PythonController::stop() {
  if (!stop_) return;
  const py::gil_scoped_acquire lock;
  reported([this] { stop_(); });
}

}  // namespace python::bindings
