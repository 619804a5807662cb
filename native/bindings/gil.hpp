// SPDX-License-Identifier: Apache-2.0
// Leaving and entering Python such that the interpreter may end meanwhile. CPython ends the other threads as they take
// the GIL, by unwinding their stack; unwound through C++ frames, the process aborts. So a thread that comes back too
// late waits in native code for the end of the process.
#pragma once

#include <Python.h>

namespace coframe::bindings {

// Within its scope other Python threads run, and nothing touches Python.
class WithoutGil {
 public:
  WithoutGil() : thread_(PyEval_SaveThread()) {}
  WithoutGil(const WithoutGil&) = delete;
  WithoutGil& operator=(const WithoutGil&) = delete;
  ~WithoutGil();

 private:
  PyThreadState* thread_;
};

// For work that is long only sometimes.
template <class Work>
void without_gil_if(bool release, Work&& work) {
  if (release) {
    const WithoutGil scope;
    work();
  } else {
    work();
  }
}

// A scope in which C++ calls Python code, where the GIL may change hands at any time.
class CallingPython {
 public:
  CallingPython();
  CallingPython(const CallingPython&) = delete;
  CallingPython& operator=(const CallingPython&) = delete;
  ~CallingPython();
};

// Whether this is the thread in which Python runs signal handlers.
bool is_main_thread();

// Registers with `atexit` what makes the scopes above safe; to be called once, while the module is imported.
void guard_exit();

}  // namespace coframe::bindings
