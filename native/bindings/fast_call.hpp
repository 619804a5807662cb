// SPDX-License-Identifier: Apache-2.0
// Functions that Python calls directly, for the few that are called millions of times: CPython's calling convention
// (METH_FASTCALL | METH_KEYWORDS) with named and optional arguments.
#pragma once

#include <nanobind/nanobind.h>

#include <array>
#include <cstddef>
#include <exception>

#include "bindings/failure.hpp"
#include "core/unfinished_change.hpp"

namespace coframe::bindings {

namespace nb = nanobind;

// The names of a function's arguments. The first `required` are required; those after `positional` are keyword-only.
template <std::size_t N>
class Signature {
 public:
  Signature(const char* function, std::array<const char*, N> names, std::size_t required, std::size_t positional)
      : function_(function), required_(required), positional_(positional) {
    for (std::size_t i = 0; i < N; ++i) names_[i] = PyUnicode_InternFromString(names[i]);
  }

  // Writes borrowed references to `values`, nullptr for omitted arguments. Returns false with an exception set.
  bool parse(PyObject* const* arguments, Py_ssize_t count, PyObject* keywords, PyObject** values) const {
    const auto given = static_cast<std::size_t>(count);
    if (given > positional_) {
      PyErr_Format(PyExc_TypeError, "%s() takes at most %zu positional arguments (%zu given)", function_, positional_,
                   given);
      return false;
    }
    for (std::size_t i = 0; i < N; ++i) values[i] = i < given ? arguments[i] : nullptr;
    if (keywords && !by_name(arguments + count, keywords, values)) return false;
    for (std::size_t i = given; i < required_; ++i) {
      if (values[i]) continue;
      PyErr_Format(PyExc_TypeError, "%s() missing the argument %R", function_, names_[i]);
      return false;
    }
    return true;
  }

 private:
  bool by_name(PyObject* const* arguments, PyObject* keywords, PyObject** values) const {
    for (Py_ssize_t k = 0; k < PyTuple_GET_SIZE(keywords); ++k) {
      PyObject* name = PyTuple_GET_ITEM(keywords, k);
      const std::size_t i = find(name);
      if (i == N || values[i]) {
        PyErr_Format(PyExc_TypeError, i == N ? "%s() got an unexpected argument %R" : "%s() got %R twice", function_,
                     name);
        return false;
      }
      values[i] = arguments[k];
    }
    return true;
  }

  std::size_t find(PyObject* name) const {
    for (std::size_t i = 0; i < N; ++i) {
      if (names_[i] == name) return i;
    }
    for (std::size_t i = 0; i < N; ++i) {
      if (PyUnicode_Compare(names_[i], name) == 0) return i;
    }
    return N;
  }

  const char* function_;
  std::array<PyObject*, N> names_;  // as long as the process lives
  std::size_t required_, positional_;
};

// Runs C++ code that may throw, called from Python; returns nullptr with the Python exception set.
template <class Body>
PyObject* guarded(Body&& body) {
  try {
    return body();
  } catch (nb::python_error& error) {
    error.restore();
  } catch (const nb::builtin_exception& error) {
    PyErr_SetString(error.type() == nb::exception_type::type_error ? PyExc_TypeError : PyExc_ValueError, error.what());
  } catch (const UnfinishedChange& error) {
    set_unfinished_change(error.what());
  } catch (const LostMemory& error) {
    set_lost_memory(error);
  } catch (const std::exception& error) {
    PyErr_SetString(PyExc_RuntimeError, error.what());
  }
  return nullptr;
}

using FastFunction = PyObject* (*)(PyObject*, PyObject* const*, Py_ssize_t, PyObject*);

// Adds a method to a class. `text` is "name($self, ...)\n--\n\n" followed by the documentation; it must live as long as
// the class.
inline void add_method(nb::handle cls, const char* name, FastFunction function, const char* text) {
  auto* definition = new PyMethodDef{name, reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(function)),
                                     METH_FASTCALL | METH_KEYWORDS, text};
  auto* type = reinterpret_cast<PyTypeObject*>(cls.ptr());
  nb::object method = nb::steal(PyDescr_NewMethod(type, definition));
  if (!method.is_valid()) throw nb::python_error();
  nb::setattr(cls, name, method);
}

}  // namespace coframe::bindings
