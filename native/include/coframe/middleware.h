/* SPDX-License-Identifier: Apache-2.0
 *
 * What coframe's native core provides to the native modules of other middlewares: a table of C functions, in the
 * capsule `coframe._core.middleware`. Such a module needs no other part of the core, and no equal compiler.
 *
 * Pointers that the functions return belong to a Python object: the module keeps a reference to that object as long as
 * it uses them. Functions without a mark may be called by any thread without the GIL; none of them throws. */
#pragma once

#include <Python.h>
#include <stddef.h>
#include <stdint.h>

/* Changes with every change of the table. A module refuses any other version. */
#define COFRAME_MIDDLEWARE_VERSION 1
#define COFRAME_MIDDLEWARE_CAPSULE "coframe._core.middleware"

#ifdef __cplusplus
extern "C" {
#endif

/* A part of a serialized message. */
typedef struct {
  const void* data;
  size_t size;
} coframe_part;

/* Sends a serialized message in `count` parts, of `size` bytes together; the first has the encapsulation. Called with
 * the GIL. Returns 0, or -1 with a Python exception. */
typedef int (*coframe_send)(void* context, const coframe_part* parts, size_t count, size_t size);

typedef struct {
  uint32_t version;

  /* An object of coframe._core.Event. GIL. NULL with a Python exception. */
  void* (*event)(PyObject* object);
  void (*set_event)(void* event);
  int (*is_event_set)(void* event);

  /* An object of coframe._core.TransformStore. GIL. NULL with a Python exception. */
  void* (*store)(PyObject* object);
  /* Stores the transforms of a serialized message. Damaged messages are counted. */
  void (*add_to_store)(void* store, uint64_t writer, const uint8_t* message, size_t size);

  /* An object of coframe._core.MessageCodec. GIL. NULL with a Python exception. */
  void* (*codec)(PyObject* object);
  /* Returns the message in CDR bytes, or None if Python code has to read it. GIL. NULL with a Python exception. */
  PyObject* (*decode)(void* codec, const uint8_t* message, size_t size);
  /* Serializes a message and sends it. With `of_items`, it is the items of the message's only field, or one item. GIL.
   * Returns 1, 0 if Python code has to serialize it, or -1 with a Python exception. */
  int (*encode)(void* codec, PyObject* message, int of_items, coframe_send send, void* context);

  /* Returns whether the bytes are a serialized TFMessage. */
  int (*is_tf_message)(const uint8_t* message, size_t size);

  /* Release the GIL and take it again; unlike Python's functions, they are safe while the interpreter ends. */
  void* (*leave_python)(void);
  void (*enter_python)(void* thread);
} coframe_middleware;

#ifdef __cplusplus
}
#endif
