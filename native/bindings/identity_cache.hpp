// SPDX-License-Identifier: Apache-2.0
// A cache of numbers by the identity of `str` objects.
#pragma once

#include <nanobind/nanobind.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "core/relaxed_atomic.hpp"
#include "core/revision.hpp"

namespace coframe::bindings {

namespace nb = nanobind;

// Whether Python threads run at the same time, without the GIL.
#ifdef Py_GIL_DISABLED
inline constexpr bool kFreeThreaded = true;
#else
inline constexpr bool kFreeThreaded = false;
#endif

// Programs use the same literals again and again; comparing pointers avoids hashing their text. The GIL guards the
// entries; without it, readers take no lock and detect an entry that is being replaced.
template <class Number, std::size_t kEntries>
class IdentityCache {
 public:
  IdentityCache() = default;
  IdentityCache(const IdentityCache&) = delete;
  IdentityCache& operator=(const IdentityCache&) = delete;
  ~IdentityCache() {
    for (Entry& entry : entries_) Py_XDECREF(entry.name.get());
  }

  // Returns 0 if it is not cached.
  Number known(PyObject* name) const { return read(entries_[place(name)], name); }

  // `find` returns the number of the object. 0 is not cached.
  template <class Find>
  Number find(PyObject* name, Find&& find) {
    Entry& entry = entries_[place(name)];
    const Number known = read(entry, name);
    return known != 0 ? known : remember(entry, name, find(name));
  }

 private:
  struct Guarded {
    Revision revision;
  };
  struct Unguarded {};
  struct Entry : std::conditional_t<kFreeThreaded, Guarded, Unguarded> {
    RelaxedAtomic<PyObject*> name;
    RelaxedAtomic<Number> number;
  };

  static std::size_t place(PyObject* name) { return (reinterpret_cast<std::uintptr_t>(name) >> 4) % kEntries; }

  static Number read_unguarded(const Entry& entry, PyObject* name) {
    return entry.name.get() == name ? entry.number.get() : Number{0};
  }

  static Number read(const Entry& entry, PyObject* name) {
    if constexpr (kFreeThreaded) {
      const std::uint64_t revision = entry.revision.number();
      const Number number = read_unguarded(entry, name);
      return revision % 2 == 0 && entry.revision.unchanged(revision) ? number : 0;
    } else {
      return read_unguarded(entry, name);
    }
  }

  Number remember(Entry& entry, PyObject* name, Number number) {
    // Releasing an instance of a subclass could run any code.
    if (number == 0 || !PyUnicode_CheckExact(name)) return number;
    PyObject* previous;
    {
      const nb::ft_lock_guard lock(writing_);
      previous = replace(entry, Py_NewRef(name), number);
    }
    Py_XDECREF(previous);
    return number;
  }

  static PyObject* replace(Entry& entry, PyObject* name, Number number) {
    PyObject* previous = entry.name;
    const auto write = [&] {
      entry.name = name;
      entry.number = number;
    };
    if constexpr (kFreeThreaded) {
      const Revision::Change change(entry.revision);
      write();
    } else {
      write();
    }
    return previous;
  }

  std::array<Entry, kEntries> entries_{};
  nb::ft_mutex writing_;
};

}  // namespace coframe::bindings
