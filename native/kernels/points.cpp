// SPDX-License-Identifier: Apache-2.0
#include <cstring>

#include "kernels/arc.hpp"
#include "kernels/level.hpp"

namespace coframe::COFRAME_LEVEL {

namespace {

struct Point {
  double x, y, z;
};

// Returns v + 2 w (u x v) + 2 u x (u x v), where u is the vector part of q. Sums are ordered so that each product and
// its addition can be one fused instruction, here and below.
COFRAME_INLINE Point rotated(double qx, double qy, double qz, double qw, const Point& v) {
  const double tx = 2.0 * (qy * v.z - qz * v.y);
  const double ty = 2.0 * (qz * v.x - qx * v.z);
  const double tz = 2.0 * (qx * v.y - qy * v.x);
  return {v.x + qw * tx + qy * tz - qz * ty, v.y + qw * ty + qz * tx - qx * tz, v.z + qw * tz + qx * ty - qy * tx};
}

// The translation of a frame: constant, or interpolated between two translations.
struct FixedOffset {
  const double* p;
  COFRAME_INLINE double add_to(double number, int k) const { return number + p[k]; }
  COFRAME_INLINE double take_from(double number, int k) const { return number - p[k]; }
};
struct MovingOffset {
  double first, second;  // the weights of both
  const double *ap, *bp;
  COFRAME_INLINE double add_to(double number, int k) const { return number + first * ap[k] + second * bp[k]; }
  COFRAME_INLINE double take_from(double number, int k) const { return number - first * ap[k] - second * bp[k]; }
};

// Transforms one point from the child to the parent of an edge with the rotation q, or with kInverse from the parent to
// the child.
template <bool kInverse, class Offset>
COFRAME_INLINE Point transformed(double qx, double qy, double qz, double qw, const Offset& offset, const Point& v) {
  if constexpr (kInverse) {
    return rotated(-qx, -qy, -qz, qw, {offset.take_from(v.x, 0), offset.take_from(v.y, 1), offset.take_from(v.z, 2)});
  }
  const Point rotated_point = rotated(qx, qy, qz, qw, v);
  return {offset.add_to(rotated_point.x, 0), offset.add_to(rotated_point.y, 1), offset.add_to(rotated_point.z, 2)};
}

template <bool kInverse, class Slerp>
void transform_moving_by(const Motion& motion, const Arc& shortest_arc, const double* __restrict fractions,
                         std::size_t n, const Points& points) {
  double aq[4], bq[4], ap[3], bp[3];
  std::memcpy(aq, motion.older.q, sizeof(aq));
  std::memcpy(ap, motion.older.p, sizeof(ap));
  std::memcpy(bp, motion.newer.p, sizeof(bp));
  for (int k = 0; k < 4; ++k) bq[k] = shortest_arc.sign * motion.newer.q[k];
  const typename Slerp::WeightAt weight(shortest_arc.cosine);
  double* __restrict xs = points.x, * __restrict ys = points.y, * __restrict zs = points.z;
  for (std::size_t i = 0; i < n; ++i) {
    const Ends<double> line = line_weights(fractions[i]);
    const double a = weight(line.first), b = weight(line.second);
    const Point point = transformed<kInverse>(a * aq[0] + b * bq[0], a * aq[1] + b * bq[1], a * aq[2] + b * bq[2],
                                              a * aq[3] + b * bq[3], MovingOffset{line.first, line.second, ap, bp},
                                              {xs[i], ys[i], zs[i]});
    xs[i] = point.x;
    ys[i] = point.y;
    zs[i] = point.z;
  }
}

template <bool kInverse>
void transform_each_by(const Pose* poses, std::size_t n, const Points& points) {
  double* __restrict xs = points.x, * __restrict ys = points.y, * __restrict zs = points.z;
  for (std::size_t i = 0; i < n; ++i) {
    const double* q = poses[i].q;
    const Point point = transformed<kInverse>(q[0], q[1], q[2], q[3], FixedOffset{poses[i].p}, {xs[i], ys[i], zs[i]});
    xs[i] = point.x;
    ys[i] = point.y;
    zs[i] = point.z;
  }
}

}  // namespace

void transform(const Affine& affine, std::size_t n, Points points) {
  double m[3][4];
  std::memcpy(m, affine.m, sizeof(m));
  double* __restrict xs = points.x, * __restrict ys = points.y, * __restrict zs = points.z;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = xs[i], y = ys[i], z = zs[i];
    xs[i] = m[0][3] + m[0][0] * x + m[0][1] * y + m[0][2] * z;
    ys[i] = m[1][3] + m[1][0] * x + m[1][1] * y + m[1][2] * z;
    zs[i] = m[2][3] + m[2][0] * x + m[2][1] * y + m[2][2] * z;
  }
}

void transform_moving(const Motion& motion, const double* fractions, std::size_t n, Points points) {
  const Arc shortest_arc = arc(motion.older.q, motion.newer.q);
  choose_slerp(shortest_arc.cosine, [&](auto slerp) {
    using Slerp = decltype(slerp);
    if (motion.inverse) {
      transform_moving_by<true, Slerp>(motion, shortest_arc, fractions, n, points);
    } else {
      transform_moving_by<false, Slerp>(motion, shortest_arc, fractions, n, points);
    }
  });
}

void transform_each(const Pose* poses, bool inverse, std::size_t n, Points points) {
  if (inverse) {
    transform_each_by<true>(poses, n, points);
  } else {
    transform_each_by<false>(poses, n, points);
  }
}

}  // namespace coframe::COFRAME_LEVEL
