#include <fmt/format.h>

#include <limits>
#include <utility>

#include "hal/types/math.h"
#include "hal/types/path_metric.h"
#include "python/bindings/agent.h"
#include "python/bindings/errors.h"
#include "python/bindings/values.h"

namespace python::bindings {
namespace {

namespace py = pybind11;

/// The random stream of an agent; asks the agent anew at each call.
struct RandomHandle {
  std::shared_ptr<AgentHandle> agent;
  hal::RandomStream& stream() const { return agent->object().random(); }
};

hal::PathMetric metric_from(py::handle statistic, py::handle direct_weight) {
  const std::string name = text_from(statistic, "statistic");
  const auto found = hal::path_statistic(name);
  if (!found) refuse(fmt::format("statistic: '{}' is none of hops, delay, min_snr, energy", name));
  const double weight = number_from(direct_weight, "direct_weight");
  if (!(weight >= 0)) refuse(fmt::format("direct_weight: {} is below 0", weight));
  return hal::path_metric(*found, weight);
}

std::size_t draw(const py::list& routes, const hal::PathMetric& metric, py::handle beta,
                 const RandomHandle& random) {
  std::vector<hal::Route> all;
  const py::tuple own(routes);  // what reads a route may be in Python and change the list
  for (const py::handle one : own) all.push_back(route_from(one));
  if (all.empty()) refuse("routes: must be at least one");
  const double exponent = number_from(beta, "beta");
  if (!(exponent >= 1)) refuse(fmt::format("beta: {} is below 1", exponent));
  return hal::draw_route(all, metric, exponent, random.stream());
}

double unary(double (*function)(double), py::handle x) { return function(number_from(x, "x")); }

}  // namespace

void add_random(py::module_& module, AgentClass& agent) {
  py::class_<RandomHandle>(module, "RandomStream",
                           "Random numbers of one agent; hal::RandomStream.")
      .def(
          "next", [](const RandomHandle& self) { return self.stream().next(); }, "64 random bits.")
      .def(
          "below",
          [](const RandomHandle& self, py::handle bound) {
            constexpr auto kLargest = std::numeric_limits<std::uint32_t>::max();
            const auto checked = count_from(bound, "bound", 1, kLargest);
            return self.stream().below(static_cast<std::uint32_t>(checked));
          },
          py::arg("bound"), "Uniform over 0 .. bound-1.")
      .def(
          "uniform", [](const RandomHandle& self) { return self.stream().uniform(); },
          "Uniform over [0, 1).")
      .def(
          "normal", [](const RandomHandle& self) { return self.stream().normal(); },
          "Normal deviate, mean 0, standard deviation 1.");
  agent.def(
      "random", [](std::shared_ptr<AgentHandle> self) { return RandomHandle{std::move(self)}; },
      "This agent's own random stream; equal seeds give equal numbers.");
  py::class_<hal::PathMetric>(module, "PathMetric",
                              "How good a path is: equation 1 of hal/types/path_metric.h.")
      .def(py::init(&metric_from), py::arg("statistic") = "hops", py::arg("direct_weight") = 1e6);
  module.def("draw_route", draw, py::arg("routes"), py::arg("metric"), py::arg("beta"),
             py::arg("random"), "Draws one of the routes by its value; its index.");
}

void add_math(py::module_& module) {
  py::module_ math = module.def_submodule(
      "math", "Elementary functions with the same bits on every processor: hal/types/math.h.");
  math.attr("pi") = hal::math::kPi;
  const auto add = [&math](const char* name, double (*function)(double)) {
    math.def(
        name, [function](py::handle x) { return unary(function, x); }, py::arg("x"));
  };
  add("sin", hal::math::sin);
  add("cos", hal::math::cos);
  add("tan", hal::math::tan);
  add("acos", hal::math::acos);
  add("exp", hal::math::exp);
  add("log", hal::math::log);
  add("log10", hal::math::log10);
  add("erfc", hal::math::erfc);
  math.def(
      "wrap_angle",
      [](py::handle x) {
        const double angle = number_from(x, "x");
        constexpr double kLargest = 1e9;  // rad
        if (!(-kLargest < angle && angle < kLargest)) {
          refuse(fmt::format("x: {} rad is no angle that can be wrapped", angle));
        }
        return hal::math::wrap_angle(angle);
      },
      py::arg("x"), "The equivalent angle in (-pi, pi], rad.");
  const auto add_two = [&math](const char* name, const char* first, const char* second,
                               double (*function)(double, double)) {
    math.def(
        name,
        [=](py::handle a, py::handle b) {
          return function(number_from(a, first), number_from(b, second));
        },
        py::arg(first), py::arg(second));
  };
  add_two("atan2", "y", "x", hal::math::atan2);
  add_two("pow", "base", "exponent", hal::math::pow);
  add_two("hypot", "x", "y", hal::math::hypot);
}

}  // namespace python::bindings
