// SPDX-License-Identifier: Apache-2.0
// The edges of one lookup, composed: quaternions and translations, each processed as one vector.
#include "kernels/arc.hpp"
#include "kernels/four.hpp"
#include "kernels/level.hpp"

namespace coframe::COFRAME_LEVEL {

namespace {

// A pose in the making; the fourth number of the translation is 0.
struct Placement {
  Four q, p;
};

COFRAME_INLINE Placement placement(const double* record) {
  Placement placed{load_shared(record), load_shared(record + 4)};
  placed.p[3] = 0.0;
  return placed;
}

COFRAME_INLINE Four cross(const Four& a, const Four& b) {
  return ordered<1, 2, 0, 3>(a * ordered<1, 2, 0, 3>(b) - ordered<1, 2, 0, 3>(a) * b);
}

// v + 2 w (u x v) + 2 u x (u x v), u the vector part.
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

// The weights of both ends.
template <class Way>
COFRAME_INLINE Two weights(Way, double share, double cosine) {
  return Way::weight(Two{1.0 - share, share}, cosine);
}
COFRAME_INLINE Two weights(Far, double share, double cosine) {
  return Two{Far::weight(1.0 - share, cosine), Far::weight(share, cosine)};
}

// interpolate() of core/pose.hpp.
COFRAME_INLINE Placement between(const Placement& older, const Placement& newer, double share) {
  const Four products = older.q * newer.q;
  const double dot = (products[0] + products[2]) + (products[1] + products[3]);
  const double size = dot < 0.0 ? -dot : dot, cosine = size < 1.0 ? size : 1.0;
  Two weight;
  choose_way(cosine, [&](auto way) { weight = weights(way, share, cosine); });
  const double second = dot < 0.0 ? -weight[1] : weight[1];
  return {weight[0] * older.q + second * newer.q, (1.0 - share) * older.p + share * newer.p};
}

COFRAME_INLINE Four conjugate(const Four& q) { return Four{-1.0, -1.0, -1.0, 1.0} * q; }

}  // namespace

// From the target to the source: only the rotation is carried from link to link, so that processors work on several
// links at once.
void chain(const Link* links, std::size_t n, Pose* end) {
  Placement all{Four{0.0, 0.0, 0.0, 1.0}, Four{}};
  for (std::size_t i = 0; i < n; ++i) {
    const Link& link = links[i];
    Placement step = placement(link.older);
    if (link.older != link.newer) step = between(step, placement(link.newer), link.share);
    if (link.down) {
      all.q = i == 0 ? conjugate(step.q) : product(all.q, conjugate(step.q));
      all.p = all.p - rotated(all.q, step.p);
    } else if (i == 0) {
      all = step;
    } else {
      all.p = all.p + rotated(all.q, step.p);
      all.q = product(all.q, step.q);
    }
  }
  std::memcpy(end->q, &all.q, sizeof(end->q));
  std::memcpy(end->p, &all.p, sizeof(end->p));
}

}  // namespace coframe::COFRAME_LEVEL
