// Python 3 inside `baraka`, for controllers in process and to ask them for their parameters: a
// library that the program loads when a scenario names a `.py` file.
#define PY_SSIZE_T_CLEAN
#include <Python.h>
#include <dlfcn.h>

#include <filesystem>
#include <string>
#include <system_error>

#include "hal/api/controller.h"
#include "python/host/host.h"

namespace {

namespace fs = std::filesystem;

/// The interpreter's lock, held while this object exists.
class Lock {
 public:
  Lock() : state_(PyGILState_Ensure()) {}
  ~Lock() { PyGILState_Release(state_); }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  PyGILState_STATE state_;
};

/// A reference that is given back.
struct Owned {
  explicit Owned(PyObject* one) : object(one) {}
  ~Owned() { Py_XDECREF(object); }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  PyObject* object;
};

/// This library's own folder, which has `python/` in a build. An installation in /usr has the
/// package where Python looks anyway; another one has it beside this folder.
fs::path own_folder() {
  Dl_info where{};
  if (dladdr(reinterpret_cast<const void*>(&own_folder), &where) == 0) return {};
  return fs::path(where.dli_fname).parent_path();
}

void look_in(const fs::path& folder) {
  PyObject* const path = PySys_GetObject("path");  // borrowed
  const Owned entry(PyUnicode_DecodeFSDefault(folder.c_str()));
  if (path != nullptr && entry.object != nullptr) PyList_Insert(path, 0, entry.object);
}

/// Begins Python once. Its extension modules look for Python's functions among the global ones.
void begin_python() {
  if (Py_IsInitialized() != 0) return;
  Dl_info where{};
  if (dladdr(reinterpret_cast<const void*>(&Py_IsInitialized), &where) != 0) {
    dlopen(where.dli_fname, RTLD_NOW | RTLD_GLOBAL | RTLD_NOLOAD);
  }
  Py_InitializeEx(0);  // signals stay the program's
  std::error_code ignored;
  for (const char* const place : {"python", "../python3/dist-packages"}) {
    const fs::path package = (own_folder() / place).lexically_normal();
    if (fs::is_directory(package / "baraka", ignored)) look_in(package);
  }
  PyEval_SaveThread();
}

/// What Python raised, in one line. @pre it raised something
std::string raised() {
  PyObject *type = nullptr, *value = nullptr, *trace = nullptr;
  PyErr_Fetch(&type, &value, &trace);
  const Owned held_type(type), held_value(value), held_trace(trace);
  const Owned text(value == nullptr ? nullptr : PyObject_Str(value));
  const char* const words = text.object == nullptr ? nullptr : PyUnicode_AsUTF8(text.object);
  return words == nullptr ? "unknown reason" : words;
}

}  // namespace

const hal::ControllerKind* baraka_python_controller(const char* file, std::string& mistake) {
  begin_python();
  const Lock lock;
  const Owned package(PyImport_ImportModule("baraka.loading"));
  if (package.object == nullptr) {
    mistake = "the Python package baraka cannot be loaded: " + raised();
    return nullptr;
  }
  const Owned capsule(PyObject_CallMethod(package.object, "kind_in_file", "s", file));
  if (capsule.object == nullptr) {
    mistake = raised();
    return nullptr;
  }
  return static_cast<const hal::ControllerKind*>(
      PyCapsule_GetPointer(capsule.object, "hal::ControllerKind"));
}
