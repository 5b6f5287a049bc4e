#include <fmt/format.h>

#include <utility>

#include "python/bindings/agent.h"
#include "python/bindings/errors.h"
#include "python/bindings/values.h"

namespace python::bindings {
namespace {

namespace py = pybind11;

/// The network of an agent; asks the agent anew at each call.
struct NetworkHandle {
  std::shared_ptr<AgentHandle> agent;
  hal::Network& network() const { return agent->object().network(); }
};

py::list routes(const NetworkHandle& self, py::handle topic, py::handle destination) {
  const std::string of_class = text_from(topic, "topic");
  const hal::AgentId to = address_from(destination, "destination");
  py::list all;
  for (const hal::Route& one : std::as_const(self.network()).routes(of_class, to)) {
    all.append(tuple_of(one));
  }
  return all;
}

hal::MessageId send(const AgentHandle& self, py::handle destination, py::handle topic,
                    py::handle payload, py::handle priority) {
  const auto number = count_from(priority, "priority", 0, hal::kHighestPriority);
  const hal::AgentId to = address_from(destination, "destination");
  return value_of(self.object().send(to, text_from(topic, "topic"), bytes_from(payload, "payload"),
                                     {.priority = static_cast<hal::Priority>(number)}));
}

}  // namespace

void add_network(py::module_& module, AgentClass& agent) {
  py::class_<NetworkHandle>(module, "Network",
                            "Routes and neighbours to which a controller subscribes.")
      .def("routes", routes, py::arg("topic"), py::arg("destination"),
           "Routes of one message class to one destination: a list of Route; empty: none.")
      .def(
          "neighbours",
          [](const NetworkHandle& self) {
            py::list all;
            for (const hal::Neighbour& one : self.network().neighbours()) {
              all.append(tuple_of(one));
            }
            return all;
          },
          "Nodes heard directly, by address: a list of Neighbour.")
      .def(
          "invalidate",
          [](const NetworkHandle& self, py::handle topic, py::handle destination) {
            const std::string of_class = text_from(topic, "topic");
            const hal::AgentId to = address_from(destination, "destination");
            value_of(self.network().invalidate(of_class, to));
          },
          py::arg("topic"), py::arg("destination"),
          "Forgets every route of the class to the destination, at this node only.");
  agent
      .def(
          "network",
          [](std::shared_ptr<AgentHandle> self) { return NetworkHandle{std::move(self)}; },
          "Routes and neighbours.")
      .def("send", send, py::arg("destination"), py::arg("topic"), py::arg("payload"),
           py::arg("priority") = 0,
           "Sends bytes to an agent, to EVERYONE or to NEIGHBOURS; returns the message's number.");
}

}  // namespace python::bindings
