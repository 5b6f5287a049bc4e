#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "hal/api/controller.h"
#include "python/bindings/agent.h"

namespace python::bindings {

/// A controller written in Python: an instance of a class below baraka.Controller. Callbacks take
/// the interpreter's lock. What a callback raises is thrown as std::runtime_error, with file and
/// line.
class PythonController final : public hal::Controller {
 public:
  /// Makes an instance of the class. @pre the lock is held; from any thread.
  /// @throws std::runtime_error  its constructor raised.
  PythonController(pybind11::handle of_class, std::shared_ptr<AgentHandle> agent,
                   const pybind11::object& python_agent, const hal::Parameters& parameters);
  ~PythonController() override;  // NOLINT(bugprone-exception-escape): it takes a lock
  PythonController(const PythonController&) = delete;
  PythonController& operator=(const PythonController&) = delete;

  void start() override;
  void step() override;
  void receive(const hal::Message& message) override;
  void timer(hal::TimerId id) override;
  void notice(hal::MessageId id, hal::Fate fate) override;
  void stop() override;

 private:
  /// A method of the instance; null: the class does not define it.
  pybind11::object method(const char* name) const;

  std::shared_ptr<AgentHandle> agent_;
  pybind11::object self_;
  pybind11::object start_, step_, receive_, timer_, notice_, stop_;
};

/// The values as baraka.Parameters. @pre the lock is held
pybind11::object parameters_of(pybind11::handle of_class, const hal::Parameters& parameters);

/// Calls `function`; what it raises becomes a std::runtime_error with file and line.
template <class Function>
auto reported(Function function);

/// "file:line: in step(): ValueError: why", from what Python raised. @pre the lock is held
std::string report_of(const pybind11::error_already_set& raised);

template <class Function>
auto reported(Function function) {
  try {
    return function();
  } catch (const pybind11::error_already_set& raised) {
    throw std::runtime_error(report_of(raised));
  }
}

}  // namespace python::bindings
