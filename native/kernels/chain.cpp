// SPDX-License-Identifier: Apache-2.0
// Composes the edges of one lookup. Each quaternion and each translation is processed as one vector.
#include "kernels/arc.hpp"
#include "kernels/four.hpp"
#include "kernels/level.hpp"

namespace coframe::COFRAME_LEVEL {

namespace {

// A pose during composition; the fourth number of the translation is 0.
struct ComposedPose {
  Four q, p;
};

COFRAME_INLINE ComposedPose load_pose(const double* record) {
  ComposedPose pose{load_shared(record), load_shared(record + 4)};
  pose.p[3] = 0.0;
  return pose;
}

COFRAME_INLINE Four cross(const Four& a, const Four& b) {
  return ordered<1, 2, 0, 3>(a * ordered<1, 2, 0, 3>(b) - ordered<1, 2, 0, 3>(a) * b);
}

// Returns v + 2 w (u x v) + 2 u x (u x v), where u is the vector part of q.
COFRAME_INLINE Four rotated(const Four& q, const Four& v) {
  const Four half = cross(q, v), t = half + half;
  return v + spread<3>(q) * t + cross(q, t);
}

COFRAME_INLINE Four product(const Four& a, const Four& b) {
  const Four first = Four{1.0, -1.0, 1.0, -1.0} * ordered<3, 2, 1, 0>(b);
  const Four second = Four{1.0, 1.0, -1.0, -1.0} * ordered<2, 3, 0, 1>(b);
  const Four third = Four{-1.0, 1.0, 1.0, -1.0} * ordered<1, 0, 3, 2>(b);
  return (spread<3>(a) * b + spread<0>(a) * first) + (spread<1>(a) * second + spread<2>(a) * third);
}

// Returns the slerp weights of both ends.
template <class Slerp>
COFRAME_INLINE Two weights(Slerp, double fraction, double cosine) {
  return Slerp::weight(Two{1.0 - fraction, fraction}, cosine);
}
COFRAME_INLINE Two weights(LargeAngle, double fraction, double cosine) {
  return Two{LargeAngle::weight(1.0 - fraction, cosine), LargeAngle::weight(fraction, cosine)};
}

COFRAME_INLINE ComposedPose between(const ComposedPose& older, const ComposedPose& newer, double fraction) {
  const Four products = older.q * newer.q;
  const double dot = (products[0] + products[2]) + (products[1] + products[3]);
  const Arc arc = shorter_arc(dot);
  Two weight;
  choose_slerp(arc.cosine, [&](auto slerp) { weight = weights(slerp, fraction, arc.cosine); });
  const Ends<double> line = line_weights(fraction);
  return {weight[0] * older.q + arc.sign * weight[1] * newer.q, line.first * older.p + line.second * newer.p};
}

COFRAME_INLINE Four conjugate(const Four& q) { return Four{-1.0, -1.0, -1.0, 1.0} * q; }

}  // namespace

// Composes from the target to the source: only the rotation depends on the previous edge, so the processor can work on
// several edges at once.
void chain(const Edge* edges, std::size_t n, Pose* end) {
  ComposedPose total{Four{0.0, 0.0, 0.0, 1.0}, Four{}};
  for (std::size_t i = 0; i < n; ++i) {
    const Edge& edge = edges[i];
    ComposedPose step = load_pose(edge.older);
    if (edge.older != edge.newer) step = between(step, load_pose(edge.newer), edge.fraction);
    if (edge.down) {
      total.q = i == 0 ? conjugate(step.q) : product(total.q, conjugate(step.q));
      total.p = total.p - rotated(total.q, step.p);
    } else if (i == 0) {
      total = step;
    } else {
      total.p = total.p + rotated(total.q, step.p);
      total.q = product(total.q, step.q);
    }
  }
  std::memcpy(end->q, &total.q, sizeof(end->q));
  std::memcpy(end->p, &total.p, sizeof(end->p));
}

}  // namespace coframe::COFRAME_LEVEL
