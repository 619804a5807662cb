// SPDX-License-Identifier: Apache-2.0
#include "core/wait_queue.hpp"

#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>

#include "bindings/arguments.hpp"
#include "bindings/bindings.hpp"
#include "bindings/transform.hpp"

namespace coframe::bindings {

namespace {

// In the wait queue as long as the Python object exists.
class WaitObject {
 public:
  WaitObject(BufferObject& buffer, const LookupQuery& query, std::shared_ptr<Mailbox> mailbox, Token token,
             nb::handle target, nb::handle source)
      : buffer_(buffer.core),
        wait_(std::make_shared<Wait>(query, std::move(mailbox), token)),
        target_(nb::borrow(target)),
        source_(nb::borrow(source)) {
    buffer_->wait_queue().add(wait_);
  }
  WaitObject(const WaitObject&) = delete;
  WaitObject& operator=(const WaitObject&) = delete;
  ~WaitObject() { cancel(); }

  nb::object transform() const {
    if (!wait_->done()) return nb::none();
    return make_transform(wait_->result().pose, wait_->result().stamp, target_, source_);
  }
  void cancel() { buffer_->wait_queue().remove(wait_); }

 private:
  std::shared_ptr<Buffer> buffer_;
  std::shared_ptr<Wait> wait_;
  nb::object target_, source_;
};

class WatchObject {
 public:
  WatchObject(BufferObject& buffer, std::string_view child, std::shared_ptr<Mailbox> mailbox, Token token)
      : buffer_(buffer.core), watch_(std::make_shared<Watch>(child, std::move(mailbox), token)) {
    buffer_->wait_queue().add(watch_);
  }
  WatchObject(const WatchObject&) = delete;
  WatchObject& operator=(const WatchObject&) = delete;
  ~WatchObject() { cancel(); }

  std::vector<std::string> take() {
    std::vector<std::string> names;
    for (const FrameId frame : watch_->take()) names.push_back(buffer_->name(frame));
    return names;
  }
  void cancel() {
    if (active_) buffer_->wait_queue().remove(watch_);
    active_ = false;
  }

 private:
  std::shared_ptr<Buffer> buffer_;
  std::shared_ptr<Watch> watch_;
  bool active_ = true;  // guarded by the GIL, or by the lock of the Python object
};

}  // namespace

void define_waiting(nb::module_& module) {
  using nb::arg;
  nb::class_<Mailbox>(module, "Mailbox", "A queue of tokens that waits and watches put when something has happened.")
      .def(nb::init<>())
      .def("put", &Mailbox::put, arg("token"), "Put a token from Python.")
      .def_prop_ro("empty", &Mailbox::empty)
      .def("take", &Mailbox::take, "Return and remove the tokens.")
      .def(
          "wait",
          [](Mailbox& self, std::int64_t timeout_ns) {
            return wait_with_signals(timeout_ns, [&](std::int64_t slice) { return self.wait_for(slice); });
          },
          arg("timeout_ns"),
          "Wait without the GIL until there is a token (True) or the time is over (negative: no limit).");
  nb::class_<WaitObject>(module, "Wait", "A lookup that waits until it succeeds.")
      .def("transform", &WaitObject::transform, "Return the transform, or None while there is none.")
      .def("cancel", &WaitObject::cancel, "Stop waiting.");
  nb::class_<WatchObject>(module, "Watch", "Records which edges change.")
      .def("take", &WatchObject::take, "Return the child frames of the edges that have changed since the last call.")
      .def("cancel", &WatchObject::cancel, nb::lock_self(), "Stop watching.");
  module.def(
      "wait",
      [](BufferObject& buffer, std::shared_ptr<Mailbox> mailbox, Token token, nb::handle target, nb::handle source,
         nb::handle stamp) {
        return std::make_unique<WaitObject>(buffer, query_of(buffer, target, source, stamp), std::move(mailbox), token,
                                            target, source);
      },
      arg("buffer"), arg("mailbox"), arg("token"), any("target"), any("source"), any("stamp"),
      "Start a lookup whose token is put into the mailbox once it succeeds.");
  module.def(
      "wait_full",
      [](BufferObject& buffer, std::shared_ptr<Mailbox> mailbox, Token token, nb::handle target,
         nb::handle target_stamp, nb::handle source, nb::handle source_stamp, nb::handle fixed) {
        return std::make_unique<WaitObject>(buffer,
                                            full_query_of(buffer, target, target_stamp, source, source_stamp, fixed),
                                            std::move(mailbox), token, target, source);
      },
      arg("buffer"), arg("mailbox"), arg("token"), any("target"), any("target_stamp"), any("source"),
      any("source_stamp"), any("fixed"), "Start a _lookup_full whose token is put into the mailbox once it succeeds.");
  module.def(
      "watch",
      [](BufferObject& buffer, std::shared_ptr<Mailbox> mailbox, Token token, std::string_view child) {
        return std::make_unique<WatchObject>(buffer, child, std::move(mailbox), token);
      },
      arg("buffer"), arg("mailbox"), arg("token"), arg("child"),
      "Put the token into the mailbox when the edge from `child` to its parent changes; \"\": any edge.");
}

}  // namespace coframe::bindings
