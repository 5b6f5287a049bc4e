#include "python/bindings/values.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "python/bindings/errors.h"

namespace python::bindings {
namespace {

namespace py = pybind11;

constexpr double kLatest = 9e9;  // s, of hal::from_seconds()

[[noreturn]] void wrong_type(std::string_view what, const char* wanted, py::handle value) {
  throw py::type_error(
      fmt::format("{}: must be {}, not {}", what, wanted, Py_TYPE(value.ptr())->tp_name));
}

/// The items of a list, a tuple or an array; texts are no lists. A tuple of its own, because what
/// reads an item may be in Python, __float__ for example, and change the list.
py::object list_from(py::handle value, std::string_view what, const char* wanted) {
  if (PyUnicode_Check(value.ptr()) || PyBytes_Check(value.ptr()) || PyDict_Check(value.ptr())) {
    wrong_type(what, wanted, value);
  }
  PyObject* const items = PySequence_Tuple(value.ptr());
  if (items == nullptr) {
    PyErr_Clear();
    wrong_type(what, wanted, value);
  }
  return py::reinterpret_steal<py::object>(items);
}

std::string item_name(std::string_view what, Py_ssize_t index) {
  return fmt::format("{}[{}]", what, index);
}

}  // namespace

double number_from(py::handle value, std::string_view what) {
  if (PyBool_Check(value.ptr()) || !PyNumber_Check(value.ptr())) {
    wrong_type(what, "a number", value);
  }
  const double number = PyFloat_AsDouble(value.ptr());
  if (number == -1.0 && PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    wrong_type(what, "a number", value);
  }
  return number;
}

std::vector<double> numbers_from(py::handle value, std::string_view what) {
  const py::object items = list_from(value, what, "a list of numbers");
  std::vector<double> numbers;
  const Py_ssize_t size = PyTuple_GET_SIZE(items.ptr());
  numbers.reserve(static_cast<std::size_t>(size));
  for (Py_ssize_t i = 0; i < size; ++i) {
    numbers.push_back(number_from(PyTuple_GET_ITEM(items.ptr(), i), item_name(what, i)));
  }
  return numbers;
}

std::string text_from(py::handle value, std::string_view what) {
  if (!PyUnicode_Check(value.ptr())) wrong_type(what, "a text (str)", value);
  Py_ssize_t size = 0;
  const char* const text = PyUnicode_AsUTF8AndSize(value.ptr(), &size);
  if (text == nullptr) {
    PyErr_Clear();
    refuse(fmt::format("{}: is a text that UTF-8 cannot encode", what));
  }
  return {text, static_cast<std::size_t>(size)};
}

std::vector<std::string> texts_from(py::handle value, std::string_view what) {
  const py::object items = list_from(value, what, "a list of texts");
  std::vector<std::string> texts;
  for (Py_ssize_t i = 0; i < PyTuple_GET_SIZE(items.ptr()); ++i) {
    texts.push_back(text_from(PyTuple_GET_ITEM(items.ptr(), i), item_name(what, i)));
  }
  return texts;
}

bool flag_from(py::handle value, std::string_view what) {
  if (!PyBool_Check(value.ptr())) wrong_type(what, "True or False", value);
  return value.ptr() == Py_True;
}

std::int64_t count_from(py::handle value, std::string_view what, std::int64_t low,
                        std::int64_t high) {
  if (PyBool_Check(value.ptr()) || !PyIndex_Check(value.ptr())) {
    wrong_type(what, "a whole number (int)", value);
  }
  const auto whole = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
  if (!whole) throw py::error_already_set();
  int overflow = 0;
  const long long number = PyLong_AsLongLongAndOverflow(whole.ptr(), &overflow);
  if (overflow != 0 || number < low || number > high) {
    refuse(fmt::format("{}: {} is outside {}..{}", what, py::str(whole).cast<std::string>(), low,
                       high));
  }
  return number;
}

hal::AgentId address_from(py::handle value, std::string_view what) {
  constexpr int kLargest = 0xffff;
  return hal::AgentId{static_cast<std::uint16_t>(count_from(value, what, 0, kLargest))};
}

hal::Time time_from(py::handle value, std::string_view what) {
  const double seconds = number_from(value, what);
  if (!(std::abs(seconds) < kLatest)) {
    refuse(fmt::format("{}: {} s is no time of a run", what, seconds));
  }
  return hal::Time{hal::from_seconds(seconds)};
}

hal::Bytes bytes_from(py::handle value, std::string_view what) {
  Py_buffer view{};
  if (PyUnicode_Check(value.ptr()) ||
      PyObject_GetBuffer(value.ptr(), &view, PyBUF_C_CONTIGUOUS) != 0) {
    PyErr_Clear();
    wrong_type(what, "bytes", value);
  }
  const auto* const first = static_cast<const std::uint8_t*>(view.buf);
  hal::Bytes bytes(first, first + view.len);
  PyBuffer_Release(&view);
  return bytes;
}

hal::Route route_from(py::handle value) {
  static constinit ValueClass route_class("Route");
  if (!py::isinstance(value, route_class.get())) wrong_type("route", "a baraka.Route", value);
  const auto part = [&value](const char* name) { return py::object(value.attr(name)); };
  constexpr int kLargest = 0xffff;
  hal::Route route;
  route.topic = text_from(part("topic"), "topic");
  route.destination = address_from(part("destination"), "destination");
  route.next_hop = address_from(part("next_hop"), "next_hop");
  route.path.hops = static_cast<std::uint16_t>(count_from(part("hops"), "hops", 0, kLargest));
  route.path.delay = time_from(part("delay"), "delay").time_since_epoch();
  route.path.min_snr_db = number_from(part("min_snr_db"), "min_snr_db");
  route.path.energy = number_from(part("energy"), "energy");
  return route;
}

py::handle ValueClass::get() {
  if (class_ == nullptr) {
    py::object found = py::module_::import("baraka.values").attr(name_);
    if (class_ == nullptr) class_ = found.release().ptr();  // unless another thread was faster
  }
  return class_;
}

py::object tuple_of(const hal::Message& message) {
  static constinit ValueClass of_class("Message");
  const auto* const data = reinterpret_cast<const char*>(message.payload.data());
  return of_class(message.source.value, message.destination.value, message.id, message.topic,
                  py::bytes(data, message.payload.size()), hal::to_number(message.priority));
}

py::object tuple_of(const hal::Route& route) {
  static constinit ValueClass of_class("Route");
  return of_class(route.topic, route.destination.value, route.next_hop.value, route.path.hops,
                  hal::to_seconds(route.path.delay), route.path.min_snr_db, route.path.energy);
}

py::object tuple_of(const hal::Neighbour& neighbour) {
  static constinit ValueClass of_class("Neighbour");
  return of_class(neighbour.id.value, hal::to_seconds(neighbour.last_heard), neighbour.rssi_dbm);
}

}  // namespace python::bindings
