// What Python callers give: names, stamps, durations, questions.
#pragma once

#include <nanobind/nanobind.h>

#include <string_view>

#include "bindings/buffer.hpp"
#include "core/question.hpp"

namespace coframe::bindings {

namespace nb = nanobind;

// Of a Python object that is one; type_error where __init__ was not called.
BufferObject& buffer_of(nb::handle object);

// Nanoseconds, by coframe.time for what is no int; None is 0.
std::int64_t to_int64(nb::handle number);
Stamp to_stamp(nb::handle stamp);
std::int64_t to_duration(nb::handle duration);

// The names stay valid as long as their objects.
Question question_of(BufferObject& buffer, nb::handle target, nb::handle source, nb::handle stamp);
Question full_question_of(BufferObject& buffer, nb::handle target, nb::handle target_stamp, nb::handle source,
                          nb::handle source_stamp, nb::handle fixed);

// An object with the buffer protocol, held while its memory is used.
class Memory {
 public:
  Memory(nb::handle object, int flags) {
    if (PyObject_GetBuffer(object.ptr(), &view_, flags) != 0) throw nb::python_error();
  }
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;
  ~Memory() { PyBuffer_Release(&view_); }

  template <class T>
  T* data() const {
    return static_cast<T*>(view_.buf);
  }
  std::size_t size() const { return static_cast<std::size_t>(view_.len); }

 private:
  Py_buffer view_;
};

}  // namespace coframe::bindings
