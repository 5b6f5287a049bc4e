#include <fmt/format.h>
#include <pybind11/numpy.h>

#include "python/bindings/agent.h"
#include "python/bindings/errors.h"
#include "python/bindings/values.h"

namespace python::bindings {
namespace {

namespace py = pybind11;

py::object tuple_of_channel(const hal::Channel& channel) {
  static constinit ValueClass of_class("Channel");
  static constinit ValueClass vec3_class("Vec3");
  return of_class(channel.id, channel.name, channel.kind, channel.unit, channel.length,
                  hal::to_seconds(channel.period), channel.frame,
                  py::array_t<double>(static_cast<py::ssize_t>(channel.headings.size()),
                                      channel.headings.data()),
                  channel.low, channel.high,
                  vec3_class(channel.position.x, channel.position.y, channel.position.z),
                  channel.heading);
}

}  // namespace

void add_readings(AgentClass& agent) {
  agent
      .def(
          "channels",
          [](const AgentHandle& self) {
            py::list all;
            for (const hal::Channel& one : self.object().channels()) {
              all.append(tuple_of_channel(one));
            }
            return all;
          },
          "The channels that this agent offers to this controller: a list of Channel.")
      .def(
          "reading",
          [](const AgentHandle& self, py::handle channel) {
            const auto values = value_of(self.object().reading(text_from(channel, "channel")));
            return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
          },
          py::arg("channel"), "Latest values of a channel, an array of its own.")
      .def(
          "relative_position",
          [](const AgentHandle& self, py::handle other) {
            static constinit ValueClass vec2_class("Vec2");
            const hal::AgentId to = address_from(other, "other");
            const auto place = value_of(self.object().relative_position(to));
            return vec2_class(place.x, place.y);
          },
          py::arg("other"), "Position of another agent in this body's frame, Vec2 [m].");
}

}  // namespace python::bindings
