// SPDX-License-Identifier: Apache-2.0
// The quaternion algebra of core/pose.hpp for one or several poses at a time: T is a double or Lanes.
#pragma once

#include "kernels/lanes.hpp"
#include "kernels/level.hpp"

namespace coframe::COFRAME_LEVEL {

namespace {

template <class T>
struct Vector {
  T x, y, z;
};

template <class T>
struct Quaternion {
  T x, y, z, w;
};

template <class T>
COFRAME_INLINE Vector<T> operator+(const Vector<T>& a, const Vector<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
COFRAME_INLINE Vector<T> operator-(const Vector<T>& a, const Vector<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
COFRAME_INLINE Vector<T> operator*(const T& scale, const Vector<T>& v) {
  return {scale * v.x, scale * v.y, scale * v.z};
}
template <class T>
COFRAME_INLINE Vector<T> cross(const Vector<T>& a, const Vector<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class T>
COFRAME_INLINE T dot(const Quaternion<T>& a, const Quaternion<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
}
template <class T>
COFRAME_INLINE Quaternion<T> conjugate(const Quaternion<T>& q) {
  return {-q.x, -q.y, -q.z, q.w};
}
template <class T>
COFRAME_INLINE Quaternion<T> operator*(const Quaternion<T>& a, const Quaternion<T>& b) {
  return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

// Returns v + 2 w (u x v) + 2 u x (u x v), where u is the vector part of the unit quaternion q.
template <class T>
COFRAME_INLINE Vector<T> rotated(const Quaternion<T>& q, const Vector<T>& v) {
  const Vector<T> half = cross({q.x, q.y, q.z}, v);
  const Vector<T> t = half + half;
  return {v.x + q.w * t.x + q.y * t.z - q.z * t.y, v.y + q.w * t.y + q.z * t.x - q.x * t.z,
          v.z + q.w * t.z + q.x * t.y - q.y * t.x};
}

template <class T>
struct Step {
  Quaternion<T> q;
  Vector<T> p;
};

// Transforms a vector across a step: from the child to the parent, or with kDown from the parent to the child.
template <bool kDown, class T>
COFRAME_INLINE Vector<T> transformed(const Step<T>& step, const Vector<T>& v) {
  if constexpr (kDown) return rotated(conjugate(step.q), v - step.p);
  return rotated(step.q, v) + step.p;
}
template <bool kDown, class T>
COFRAME_INLINE Step<T> transformed(const Step<T>& step, const Step<T>& pose) {
  if constexpr (kDown) return {conjugate(step.q) * pose.q, transformed<kDown>(step, pose.p)};
  return {step.q * pose.q, transformed<kDown>(step, pose.p)};
}

// The same as canonicalise() of core/pose.hpp, for quaternions that are not zero and whose squared length is a normal
// number.
COFRAME_INLINE Quaternion<Lanes> canonical(const Quaternion<Lanes>& q) {
  const Lanes x2 = q.x * q.x, y2 = q.y * q.y, z2 = q.z * q.z, length2 = x2 + y2 + z2 + q.w * q.w;
  const Lanes larger = x2 < y2 ? q.y : q.x, larger2 = x2 < y2 ? y2 : x2;
  const Lanes largest = larger2 < z2 ? q.z : larger;
  const Lanes leading = 4.0 * q.w * q.w <= length2 ? largest : q.w;
  const Lanes scale = with_sign(1.0 / root(length2), sign_of(leading));
  return {scale * q.x, scale * q.y, scale * q.z, scale * q.w};
}

}  // namespace

}  // namespace coframe::COFRAME_LEVEL
