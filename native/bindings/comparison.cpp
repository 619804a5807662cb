// SPDX-License-Identifier: Apache-2.0
// How MessageCodec compares messages.
#include "bindings/message_codec.hpp"
#include "bindings/slots.hpp"

namespace coframe::bindings {

namespace {

using Answer = MessageCodec::Answer;

// Compares with `!=`, as Python code does it: a NaN differs from itself.
Answer compare_values(PyObject* left, PyObject* right) {
  if (PyFloat_CheckExact(left) && PyFloat_CheckExact(right)) {
    return PyFloat_AS_DOUBLE(left) == PyFloat_AS_DOUBLE(right) ? Answer::kEqual : Answer::kDifferent;
  }
  const nb::object differ = nb::steal(PyObject_RichCompare(left, right, Py_NE));
  const int truth = differ.is_valid() ? PyObject_IsTrue(differ.ptr()) : -1;
  if (truth < 0) throw nb::python_error();
  return truth ? Answer::kDifferent : Answer::kEqual;
}

}  // namespace

Answer MessageCodec::compare_messages(PyObject* left, PyObject* right) const {
  for (const Field& field : fields_) {
    const nb::object ours = read_slot(left, field.slot), theirs = read_slot(right, field.slot);
    if (!ours.is_valid() || !theirs.is_valid() || field.dtype.is_valid()) return Answer::kUnknown;
    const bool are_messages =
        field.container == kSingle && field.message && field.message->is(ours.ptr()) && field.message->is(theirs.ptr());
    const Answer answer = are_messages ? field.message->compare_messages(ours.ptr(), theirs.ptr())
                                       : compare_values(ours.ptr(), theirs.ptr());
    if (answer != Answer::kEqual) return answer;
  }
  return Answer::kEqual;
}

nb::object MessageCodec::equal(nb::handle left, nb::handle right) const {
  if (!is(left.ptr()) || !is(right.ptr())) return nb::none();
  const Answer answer = compare_messages(left.ptr(), right.ptr());
  return answer == Answer::kUnknown ? nb::object(nb::none()) : nb::cast(answer == Answer::kEqual);
}

}  // namespace coframe::bindings
