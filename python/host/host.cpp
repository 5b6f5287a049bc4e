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

/// Begins Python as this interpreter. Without a name Python would take the first `python3` of PATH,
/// which may be a version manager's, with other modules than the controllers' processes have.
/// Signals stay the program's. Returns what is wrong, empty: nothing.
std::string begin_as(const char* interpreter) {
  PyConfig config;
  PyConfig_InitPythonConfig(&config);
  config.install_signal_handlers = 0;
  config.parse_argv = 0;
  PyStatus status = PyConfig_SetBytesString(&config, &config.program_name, interpreter);
  if (PyStatus_Exception(status) == 0) status = Py_InitializeFromConfig(&config);
  PyConfig_Clear(&config);
  if (PyStatus_Exception(status) == 0) return {};
  return std::string(interpreter) +
         " cannot begin: " + (status.err_msg == nullptr ? "unknown reason" : status.err_msg);
}

/// Begins Python once. Its extension modules look for Python's functions among the global ones.
std::string begin_python(const char* interpreter) {
  if (Py_IsInitialized() != 0) return {};
  Dl_info where{};
  if (dladdr(reinterpret_cast<const void*>(&Py_IsInitialized), &where) != 0) {
    dlopen(where.dli_fname, RTLD_NOW | RTLD_GLOBAL | RTLD_NOLOAD);
  }
  if (std::string mistake = begin_as(interpreter); !mistake.empty()) return mistake;
  std::error_code ignored;
  for (const char* const place : {"python", "../python3/dist-packages"}) {
    const fs::path package = (own_folder() / place).lexically_normal();
    if (fs::is_directory(package / "baraka", ignored)) look_in(package);
  }
  PyEval_SaveThread();
  return {};
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

const hal::ControllerKind* baraka_python_controller(const char* file, const char* interpreter,
                                                    std::string& mistake) {
  if (mistake = begin_python(interpreter); !mistake.empty()) return nullptr;
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
