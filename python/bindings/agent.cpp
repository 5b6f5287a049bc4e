#include "python/bindings/agent.h"

#include <fmt/format.h>

#include <stdexcept>

#include "python/bindings/errors.h"
#include "python/bindings/values.h"

namespace python::bindings {
namespace {

namespace py = pybind11;

hal::log::Level level_from(py::handle value) {
  const std::string name = text_from(value, "level");
  const auto level = hal::log::level_called(name);
  if (!level) refuse(fmt::format("level: '{}' is none of debug, info, warning, error", name));
  return *level;
}

py::object or_none(const auto& optional) {
  if (!optional) return py::none();
  if constexpr (std::is_same_v<std::decay_t<decltype(*optional)>, hal::AgentId>) {
    return py::int_(optional->value);
  } else {
    return py::str(std::string(*optional));
  }
}

void add_identity(AgentClass& agent) {
  agent
      .def(
          "id", [](const AgentHandle& self) { return self.object().id().value; },
          "Address of this agent, 1..65533.")
      .def(
          "name", [](const AgentHandle& self) { return std::string(self.object().name()); },
          "Name of this agent, for people.")
      .def(
          "now", [](const AgentHandle& self) { return hal::to_seconds(self.object().now()); },
          "Time of the event being handled, s since the start of the run.")
      .def(
          "now_ns", [](const AgentHandle& self) { return hal::to_ns(self.object().now()); },
          "The same in whole nanoseconds, as the run counts: differences are exact.")
      .def(
          "control_period",
          [](const AgentHandle& self) { return hal::to_seconds(self.object().control_period()); },
          "Time between two calls of step(), s.")
      .def(
          "air_interface",
          [](const AgentHandle& self) { return std::string(self.object().air_interface()); },
          "The only network interface for sockets of this controller; empty: there is none.")
      .def(
          "address_of",
          [](const AgentHandle& self, py::handle name) {
            return or_none(self.object().address_of(text_from(name, "name")));
          },
          py::arg("name"),
          "Address of the agent of that name; None: unknown. Only with `names = True`.")
      .def(
          "name_of",
          [](const AgentHandle& self, py::handle agent_id) {
            const hal::AgentId named = address_from(agent_id, "agent");
            return or_none(self.object().name_of(named));
          },
          py::arg("agent"), "Name of the agent; None: unknown. Only with `names = True`.");
}

void add_record(AgentClass& agent) {
  agent
      .def(
          "state",
          [](const AgentHandle& self, py::handle name) {
            self.object().state(text_from(name, "name"));
          },
          py::arg("name"), "Declares the state of the controller.")
      .def(
          "record",
          [](const AgentHandle& self, py::handle name, py::handle value) {
            const double number = number_from(value, "value");
            self.object().record(text_from(name, "name"), number);
          },
          py::arg("name"), py::arg("value"), "Records a finite number in the results.")
      .def(
          "log",
          [](const AgentHandle& self, py::handle level, py::handle text) {
            self.object().log(level_from(level), text_from(text, "text"));
          },
          py::arg("level"), py::arg("text"),
          "Writes a line to the log: level is debug, info, warning or error.");
}

void add_power(AgentClass& agent) {
  agent
      .def(
          "battery", [](const AgentHandle& self) { return value_of(self.object().battery()); },
          "State of charge, 0..1.")
      .def(
          "battery_energy",
          [](const AgentHandle& self) { return value_of(self.object().battery_energy()); },
          "Energy in the battery now, J.")
      .def(
          "battery_capacity",
          [](const AgentHandle& self) { return value_of(self.object().battery_capacity()); },
          "Energy in the battery when it is full, J.")
      .def(
          "set_radio",
          [](const AgentHandle& self, py::handle on) {
            self.object().set_radio(flag_from(on, "on"));
          },
          py::arg("on"), "Switches the radio on or off.")
      .def(
          "set_timer",
          [](const AgentHandle& self, py::handle id, py::handle at) {
            constexpr std::int64_t kLargest = 0xffffffff;
            const auto timer = static_cast<hal::TimerId>(count_from(id, "id", 0, kLargest));
            const hal::Time expires = time_from(at, "at");
            value_of(self.object().set_timer(timer, expires));
          },
          py::arg("id"), py::arg("at"),
          "timer(id) is called at `at`, s since the start of the run, to the nearest nanosecond.");
}

}  // namespace

hal::RealWorldObject& AgentHandle::object() const {
  if (object_ == nullptr) {
    throw std::logic_error("the controller of this agent has ended, and its calls with it");
  }
  return *object_;
}

void add_agents(py::module_& module) {
  AgentClass agent(module, "RealWorldObject", "An agent with a radio: a mote or a robot.");
  agent.def("__repr__", [](py::handle self) {
    const auto& handle = self.cast<const AgentHandle&>();
    const std::string kind = py::str(py::type::handle_of(self).attr("__name__"));
    try {
      return fmt::format("<baraka.{} {}>", kind, handle.object().name());
    } catch (const std::logic_error&) {  // outside a callback
      return fmt::format("<baraka.{}>", kind);
    }
  });
  add_identity(agent);
  add_record(agent);
  add_power(agent);
  add_readings(agent);
  add_network(module, agent);
  add_random(module, agent);
  const py::class_<MoteHandle, AgentHandle, std::shared_ptr<MoteHandle>> mote(
      module, "Mote", "An agent without wheels.");
  add_robot(module);
}

}  // namespace python::bindings
