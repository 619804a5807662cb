// SPDX-License-Identifier: Apache-2.0
// Scopes that leave and enter Python and are safe when the interpreter ends in the meantime. CPython ends other threads
// as they take the GIL by unwinding their stacks, and unwinding through C++ frames aborts the process. A thread that
// returns too late therefore waits in native code for the end of the process.
#pragma once

#include <Python.h>

namespace coframe::bindings {

// Releases the GIL, and takes it again.
PyThreadState* leave_python();
void enter_python(PyThreadState* thread);

// A scope without the GIL: other Python threads run, and nothing in it may use Python.
class WithoutGil {
 public:
  WithoutGil() : thread_(leave_python()) {}
  WithoutGil(const WithoutGil&) = delete;
  WithoutGil& operator=(const WithoutGil&) = delete;
  ~WithoutGil() { enter_python(thread_); }

 private:
  PyThreadState* thread_;
};

// The same on condition, for work that only sometimes takes long.
template <class Work>
void without_gil_if(bool release, Work&& work) {
  if (release) {
    const WithoutGil scope;
    work();
  } else {
    work();
  }
}

// A scope in which C++ calls Python code and the GIL may be released at any time.
class CallingPython {
 public:
  CallingPython();
  CallingPython(const CallingPython&) = delete;
  CallingPython& operator=(const CallingPython&) = delete;
  ~CallingPython();
};

// Returns whether this is the thread in which Python runs signal handlers.
bool is_main_thread();

// Registers the `atexit` handler that makes the scopes above safe. Called once, during the import of the module.
void guard_exit();

}  // namespace coframe::bindings
