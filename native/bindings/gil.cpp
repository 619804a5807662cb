// SPDX-License-Identifier: Apache-2.0
#include "bindings/gil.hpp"

#include <nanobind/nanobind.h>

#include <atomic>
#include <chrono>
#include <thread>

#ifndef _WIN32
#include <pthread.h>
#endif

namespace coframe::bindings {

namespace {

namespace nb = nanobind;

// How long the end of the interpreter waits for threads that are entering Python.
constexpr auto kMaxWait = std::chrono::seconds(1);

std::atomic<bool> ending = false;
std::atomic<int> crossing = 0;  // threads that are entering Python, or called from C++ inside it
std::thread::id last_thread;    // the thread that runs the exit handlers; set before `ending`
std::atomic<unsigned long> main_thread = 0;

// The counter is incremented before `ending` is read, and `ending` is set before the counter is read: one side always
// sees the other.
bool may_cross() {
  crossing.fetch_add(1);
  if (!ending.load() || std::this_thread::get_id() == last_thread) return true;
  crossing.fetch_sub(1);
  return false;
}

[[noreturn]] void wait_for_end_of_process() {
  for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
}

// From now on no thread enters; waits for those that are entering.
void end() {
  last_thread = std::this_thread::get_id();
  ending.store(true);
  PyThreadState* thread = PyEval_SaveThread();
  const auto deadline = std::chrono::steady_clock::now() + kMaxWait;
  while (crossing.load() > 0 && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::sleep_for(std::chrono::microseconds(50));
  }
  PyEval_RestoreThread(thread);
}

}  // namespace

PyThreadState* leave_python() { return PyEval_SaveThread(); }

void enter_python(PyThreadState* thread) {
  if (!may_cross()) wait_for_end_of_process();
  PyEval_RestoreThread(thread);
  crossing.fetch_sub(1);
}

CallingPython::CallingPython() {
  if (may_cross()) return;
  PyEval_SaveThread();
  wait_for_end_of_process();
}

CallingPython::~CallingPython() { crossing.fetch_sub(1); }

bool is_main_thread() { return PyThread_get_thread_ident() == main_thread.load(std::memory_order_relaxed); }

void guard_exit() {
  main_thread.store(nb::cast<unsigned long>(nb::module_::import_("threading").attr("main_thread")().attr("ident")));
  // Exit handlers run in reverse order: those of modules that import this one still find all threads running.
  nb::module_::import_("atexit").attr("register")(nb::cpp_function(&end));
#ifndef _WIN32
  pthread_atfork(nullptr, nullptr, [] {
    crossing.store(0);  // a forked child has none of the other threads
    main_thread.store(PyThread_get_thread_ident());
  });
#endif
}

}  // namespace coframe::bindings
