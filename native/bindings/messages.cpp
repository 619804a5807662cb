// SPDX-License-Identifier: Apache-2.0
// Reads and creates the messages of the drop-in packages slot by slot: the classes of geometry_msgs are Python classes
// with __slots__, and access by attribute costs more than the lookup. Other classes are left to Python code.
#include <nanobind/nanobind.h>

#include <array>

#include "bindings/arguments.hpp"
#include "bindings/bindings.hpp"
#include "bindings/fast_call.hpp"
#include "bindings/slots.hpp"

namespace coframe::bindings {

namespace {

constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;

#ifdef Py_GIL_DISABLED
// Another thread may replace the value of a slot at any time.
using SlotValue = nb::object;
SlotValue hold(PyObject* value) { return nb::borrow(value); }
#else
using SlotValue = nb::handle;
SlotValue hold(PyObject* value) { return value; }
#endif

// A class and the offsets of its slots in an instance, in the order of `names`.
template <std::size_t N>
class SlottedClass {
 public:
  void set(nb::handle cls, const std::array<const char*, N>& names) {
    type_ = reinterpret_cast<PyTypeObject*>(cls.inc_ref().ptr());  // as long as the process lives
    for (std::size_t i = 0; i < N; ++i) offsets_[i] = slot_offset(cls, names[i]);
  }
  bool is(nb::handle object) const { return object.is_valid() && Py_TYPE(object.ptr()) == type_; }
  // Returns an invalid handle if the attribute was deleted.
  SlotValue get(nb::handle object, std::size_t i) const {
    const nb::ft_object_guard lock(object);
    return hold(slot(object.ptr(), i));
  }
  // Steals `value`.
  void put(PyObject* object, std::size_t i, PyObject* value) const { slot(object, i) = value; }
  // Creates an instance without __init__: the caller must set every slot.
  PyObject* make() const {
    PyObject* object = type_->tp_alloc(type_, 0);
    if (!object) throw nb::python_error();
    return object;
  }

 private:
  PyObject*& slot(PyObject* object, std::size_t i) const { return slot_at(object, offsets_[i]); }

  PyTypeObject* type_ = nullptr;
  std::array<Py_ssize_t, N> offsets_{};
};

SlottedClass<3> transform_stamped;  // header, child_frame_id, transform
SlottedClass<2> header;             // stamp, frame_id
SlottedClass<2> time_message;       // sec, nanosec
SlottedClass<1> rclpy_time;         // nanoseconds
SlottedClass<2> transform;          // translation, rotation
SlottedClass<3> vector3;
SlottedClass<4> quaternion;

bool is_text(nb::handle object) { return object.is_valid() && PyUnicode_CheckExact(object.ptr()); }

bool read_int(nb::handle object, std::int64_t& value) {
  return object.is_valid() && to_int64_if_exact(object.ptr(), value);
}

bool read_time(nb::handle object, Stamp& stamp) {
  if (rclpy_time.is(object)) return read_int(rclpy_time.get(object, 0), stamp);
  if (!time_message.is(object)) return false;
  std::int64_t seconds, nanoseconds;
  if (!read_int(time_message.get(object, 0), seconds) || !read_int(time_message.get(object, 1), nanoseconds)) {
    return false;
  }
  if (seconds > 9'000'000'000 || seconds < -9'000'000'000) return false;
  stamp = seconds * kNanosecondsPerSecond + nanoseconds;
  return true;
}

template <std::size_t N>
bool read_numbers(const SlottedClass<N>& cls, nb::handle object, double* out) {
  if (!cls.is(object)) return false;
  for (std::size_t i = 0; i < N; ++i) {
    const SlotValue number = cls.get(object, i);
    if (!number.is_valid() || !PyFloat_CheckExact(number.ptr())) return false;
    out[i] = PyFloat_AS_DOUBLE(number.ptr());
  }
  return true;
}

struct MessageValues {
  SlotValue parent, child;
  Stamp stamp;
  TransformValues values;
};

bool read_message(nb::handle message, MessageValues& content) {
  if (!transform_stamped.is(message)) return false;
  const SlotValue head = transform_stamped.get(message, 0), pose = transform_stamped.get(message, 2);
  if (!header.is(head) || !transform.is(pose)) return false;
  content.parent = header.get(head, 1);
  content.child = transform_stamped.get(message, 1);
  return is_text(content.parent) && is_text(content.child) && read_time(header.get(head, 0), content.stamp) &&
         read_numbers(vector3, transform.get(pose, 0), content.values.translation) &&
         read_numbers(quaternion, transform.get(pose, 1), content.values.rotation);
}

template <std::size_t N>
nb::object make_numbers(const SlottedClass<N>& cls, const double* values) {
  nb::object object = nb::steal(cls.make());
  for (std::size_t i = 0; i < N; ++i) cls.put(object.ptr(), i, PyFloat_FromDouble(values[i]));
  return object;
}

nb::object make_message(PyObject* target, PyObject* source, Stamp stamp, const Pose& pose) {
  std::int64_t seconds = stamp / kNanosecondsPerSecond, nanoseconds = stamp % kNanosecondsPerSecond;
  if (nanoseconds < 0) {
    nanoseconds += kNanosecondsPerSecond;
    --seconds;
  }
  nb::object stamp_message = nb::steal(time_message.make());
  time_message.put(stamp_message.ptr(), 0, PyLong_FromLongLong(seconds));
  time_message.put(stamp_message.ptr(), 1, PyLong_FromLongLong(nanoseconds));
  nb::object header_message = nb::steal(header.make());
  header.put(header_message.ptr(), 0, stamp_message.release().ptr());
  header.put(header_message.ptr(), 1, Py_NewRef(target));
  nb::object transform_message = nb::steal(transform.make());
  transform.put(transform_message.ptr(), 0, make_numbers(vector3, pose.p).release().ptr());
  transform.put(transform_message.ptr(), 1, make_numbers(quaternion, pose.q).release().ptr());
  nb::object message = nb::steal(transform_stamped.make());
  transform_stamped.put(message.ptr(), 0, header_message.release().ptr());
  transform_stamped.put(message.ptr(), 1, Py_NewRef(source));
  transform_stamped.put(message.ptr(), 2, transform_message.release().ptr());
  return message;
}

// Returns None if Python code has to handle the message.
PyObject* set_message(PyObject* object, PyObject* const* arguments, Py_ssize_t count, PyObject* keywords) {
  static const Signature<3> signature("_set_message", {"message", "static", "authority"}, 3, 3);
  PyObject* values[3];
  if (!signature.parse(arguments, count, keywords, values)) return nullptr;
  return guarded([&]() -> PyObject* {
    BufferObject& self = buffer_of(object);
    MessageValues content;
    if (!PyUnicode_CheckExact(values[2]) || !read_message(values[0], content)) return Py_NewRef(Py_None);
    const FrameId parent = self.frame(content.parent.ptr()), child = self.frame(content.child.ptr());
    if (parent == 0 || child == 0 || parent == child) return Py_NewRef(Py_None);
    const bool is_static = PyObject_IsTrue(values[1]) == 1;
    return PyLong_FromUnsignedLong(self.insert([&] {
      return self.core->insert(parent, child, content.stamp, content.values, is_static, self.authority(values[2]));
    }));
  });
}

PyObject* lookup_message(PyObject* object, PyObject* const* arguments, Py_ssize_t count, PyObject* keywords) {
  static const Signature<3> signature("_lookup_message", {"target", "source", "time"}, 3, 3);
  PyObject* values[3];
  if (!signature.parse(arguments, count, keywords, values)) return nullptr;
  return guarded([&]() -> PyObject* {
    BufferObject& self = buffer_of(object);
    Stamp stamp;
    Pose pose;
    if (!is_text(values[0]) || !is_text(values[1]) || !read_time(values[2], stamp)) return Py_NewRef(Py_None);
    const FrameId target = self.frame(values[0]), source = self.frame(values[1]);
    const bool found =
        target != 0 && source != 0 && target != source && self.lookup_cached_path(target, source, stamp, pose);
    return found ? make_message(values[0], values[1], stamp, pose).release().ptr() : Py_NewRef(Py_None);
  });
}

}  // namespace

void define_messages(nb::module_& module) {
  const nb::object buffer = module.attr("Buffer");
  add_method(buffer, "_set_message", &set_message,
             "_set_message($self, /, message, static, authority)\n--\n\n"
             "Insert a TransformStamped between known frames; return None for all other arguments.");
  add_method(buffer, "_lookup_message", &lookup_message,
             "_lookup_message($self, /, target, source, time)\n--\n\n"
             "Look up a TransformStamped at a Time; return None if lookup() has to decide.");
  module.def(
      "register_messages",
      [](nb::type_object stamped, nb::type_object head, nb::type_object stamp, nb::type_object rclpy_stamp,
         nb::type_object pose, nb::type_object translation, nb::type_object rotation) {
        transform_stamped.set(stamped, {"_header", "_child_frame_id", "_transform"});
        header.set(head, {"_stamp", "_frame_id"});
        time_message.set(stamp, {"_sec", "_nanosec"});
        rclpy_time.set(rclpy_stamp, {"_nanoseconds"});
        transform.set(pose, {"_translation", "_rotation"});
        vector3.set(translation, {"_x", "_y", "_z"});
        quaternion.set(rotation, {"_x", "_y", "_z", "_w"});
      },
      nb::arg("transform_stamped"), nb::arg("header"), nb::arg("time"), nb::arg("rclpy_time"), nb::arg("transform"),
      nb::arg("vector3"), nb::arg("quaternion"),
      "Register the classes that _set_message() reads and _lookup_message() creates.");
}

}  // namespace coframe::bindings
