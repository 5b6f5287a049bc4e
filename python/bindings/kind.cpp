#include "python/bindings/kind.h"

#include <fmt/format.h>

#include <deque>
#include <memory>
#include <utility>

#include "python/bindings/controller.h"
#include "python/bindings/errors.h"
#include "python/bindings/values.h"

namespace python::bindings {
namespace {

namespace py = pybind11;

hal::Naming naming_from(const std::string& name, const std::string& parameter) {
  if (name.empty()) return hal::Naming::kNothing;
  if (name == "agent") return hal::Naming::kAgent;
  if (name == "other agent") return hal::Naming::kOtherAgent;
  if (name == "sent topic") return hal::Naming::kSentTopic;
  if (name == "heard topic") return hal::Naming::kHeardTopic;
  refuse(
      fmt::format("parameters: {}: names: '{}' is none of agent, other agent, sent topic, "
                  "heard topic",
                  parameter, name));
}

hal::ParameterValue value_from(py::handle value, const std::string& kind, const std::string& what) {
  if (kind == "flag") return flag_from(value, what);
  if (kind == "text") return text_from(value, what);
  if (kind == "number") return number_from(value, what);
  if (kind == "numbers") return numbers_from(value, what);
  return texts_from(value, what);
}

/// What decides by the parameters, asked in Python. The object is never freed.
template <class Answer>
std::function<Answer(const hal::Parameters&)> asked(py::handle of_class, py::object function,
                                                    Answer (*read)(const py::object&)) {
  PyObject* const kept = function.release().ptr();
  return [of_class, kept, read](const hal::Parameters& parameters) {
    const py::gil_scoped_acquire lock;
    return reported([&] {
      return read(py::reinterpret_borrow<py::object>(kept)(parameters_of(of_class, parameters)));
    });
  };
}

bool truth_of(const py::object& answer) { return py::bool_(answer); }

std::vector<hal::ParameterMistake> mistakes_in(const py::object& answer) {
  std::vector<hal::ParameterMistake> all;
  if (answer.is_none()) return all;
  for (const py::handle one : answer) {
    const auto part = [&one](const char* name) { return py::object(one.attr(name)); };
    all.push_back({.name = text_from(part("name"), "name of a mistake"),
                   .what = text_from(part("what"), "text of a mistake"),
                   .can_work = flag_from(part("can_work"), "can_work of a mistake")});
  }
  return all;
}

hal::ParameterSpec spec_of(py::handle of_class, const std::string& name, py::handle given) {
  if (!py::isinstance(given, py::module_::import("baraka.controller").attr("Parameter"))) {
    refuse(fmt::format("parameters: {}: must be a baraka.Parameter", name));
  }
  const auto part = [&given](const char* attribute) { return py::object(given.attr(attribute)); };
  const auto what = [&name](const char* attribute) {
    return fmt::format("parameters: {}: {}", name, attribute);
  };
  hal::ParameterSpec spec;
  spec.name = name;
  spec.unit = text_from(part("unit"), what("unit"));
  spec.default_value =
      value_from(part("default"), part("kind").cast<std::string>(), what("default"));
  spec.low = number_from(part("low"), what("low"));
  spec.high = number_from(part("high"), what("high"));
  spec.meaning = text_from(part("meaning"), what("meaning"));
  spec.choices = texts_from(part("choices"), what("choices"));
  spec.names = naming_from(text_from(part("names"), what("names")), name);
  spec.besides = texts_from(part("besides"), what("besides"));
  if (!part("is_used").is_none()) spec.is_used = asked(of_class, part("is_used"), truth_of);
  return spec;
}

std::vector<hal::RecordSpec> records_of(const py::object& given) {
  std::vector<hal::RecordSpec> all;
  for (const auto& [key, value] : given.cast<py::dict>()) {
    const std::string name = text_from(key, "records: name");
    const auto parts = texts_from(value, fmt::format("records: {}", name));
    if (parts.size() != 2) {
      refuse(fmt::format("records: {}: must be a unit and a meaning", name));
    }
    all.push_back({.name = name, .unit = parts[0], .meaning = parts[1]});
  }
  return all;
}

template <class Handle, class Agent>
std::unique_ptr<hal::Controller> make(py::handle of_class, Agent& agent,
                                      const hal::Parameters& parameters) {
  const py::gil_scoped_acquire lock;
  auto handle = std::make_shared<Handle>(agent);
  const py::object seen = py::cast(handle);
  return std::make_unique<PythonController>(of_class, std::move(handle), seen, parameters);
}

void set_makers(hal::ControllerKind& kind, py::handle of_class) {
  for (const std::string& one : texts_from(of_class.attr("runs_on"), "runs_on")) {
    if (one == "robot") {
      kind.make_for_robot = [of_class](hal::Robot& robot, const hal::Parameters& parameters) {
        return make<RobotHandle>(of_class, robot, parameters);
      };
    } else if (one == "mote") {
      kind.make_for_mote = [of_class](hal::Mote& mote, const hal::Parameters& parameters) {
        return make<MoteHandle>(of_class, mote, parameters);
      };
    } else {
      refuse(fmt::format("runs_on: '{}' is neither 'robot' nor 'mote'", one));
    }
  }
  if (!kind.make_for_robot && !kind.make_for_mote) refuse("runs_on: names no kind of agent");
}

hal::ControllerKind described(py::handle of_class, const std::string& name) {
  const auto part = [&of_class](const char* attribute) {
    return py::object(of_class.attr(attribute));
  };
  hal::ControllerKind kind;
  kind.name = name;
  kind.wants.channels = texts_from(part("channels"), "channels");
  kind.wants.optional = texts_from(part("optional_channels"), "optional_channels");
  kind.wants.watched = texts_from(part("watched"), "watched");
  kind.wants.neighbours = flag_from(part("neighbours"), "neighbours");
  kind.wants.names = flag_from(part("names"), "names");
  if (!PyDict_Check(part("parameters").ptr())) throw py::type_error("parameters: must be a dict");
  for (const auto& [key, value] : part("parameters").cast<py::dict>()) {
    kind.parameters.push_back(spec_of(of_class, text_from(key, "parameters: name"), value));
  }
  if (!part("judge").is_none()) kind.judge = asked(of_class, part("judge"), mistakes_in);
  kind.states = texts_from(part("states"), "states");
  if (!PyDict_Check(part("records").ptr())) throw py::type_error("records: must be a dict");
  kind.records = records_of(part("records"));
  set_makers(kind, of_class);
  return kind;
}

}  // namespace

const hal::ControllerKind& kind_of(py::handle of_class, const std::string& name) {
  // Addresses in it stay, and it is never freed: controllers use it to the end.
  static auto& kinds = *new std::deque<hal::ControllerKind>;
  hal::ControllerKind kind = described(of_class, name);
  of_class.inc_ref();
  return kinds.emplace_back(std::move(kind));
}

}  // namespace python::bindings
