// SPDX-License-Identifier: Apache-2.0
// Many lookups along one path: poses are in vector registers, samples and rows in the order of the buffer and the
// result.
#include "kernels/arc.hpp"
#include "kernels/lanes.hpp"
#include "kernels/level.hpp"
#include "kernels/lie.hpp"
#include "kernels/pose_rows.hpp"
#include "kernels/rotation.hpp"

namespace coframe::COFRAME_LEVEL {

namespace {

COFRAME_INLINE Quaternion<Lanes> load_rotations(const double* const* samples) {
  Quaternion<Lanes> q;
  load_columns(samples, 0, q.x, q.y);
  load_columns(samples, 2, q.z, q.w);
  return q;
}

COFRAME_INLINE Vector<Lanes> load_translations(const double* const* samples) {
  Vector<Lanes> p;
  Lanes other;
  load_columns(samples, 4, p.x, p.y);
  load_columns(samples, 6, p.z, other);
  return p;
}

COFRAME_INLINE TwistLanes load(const TwistRows& rows, std::size_t i) {
  return {{load_lanes(rows.linear[0] + i), load_lanes(rows.linear[1] + i), load_lanes(rows.linear[2] + i)},
          {load_lanes(rows.angular[0] + i), load_lanes(rows.angular[1] + i), load_lanes(rows.angular[2] + i)}};
}

COFRAME_INLINE void store(const TwistLanes& twist, TwistRows& rows, std::size_t i) {
  store_lanes(twist.linear.x, rows.linear[0] + i);
  store_lanes(twist.linear.y, rows.linear[1] + i);
  store_lanes(twist.linear.z, rows.linear[2] + i);
  store_lanes(twist.angular.x, rows.angular[0] + i);
  store_lanes(twist.angular.y, rows.angular[1] + i);
  store_lanes(twist.angular.z, rows.angular[2] + i);
}

// Transforms velocities across a step: from the child to the parent, which also observes the motion of the step, or
// with kDown from the parent to the child, which does not observe its own motion. `pose` is the pose before this step.
template <bool kDown>
COFRAME_INLINE TwistLanes transformed(const PoseLanes& step, const TwistLanes& rate, const PoseLanes& pose,
                                      const TwistLanes& twist) {
  if constexpr (kDown) {
    const Quaternion<Lanes> inverse_rotation = conjugate(step.q);
    return {rotated(inverse_rotation, twist.linear - rate.linear - cross(rate.angular, pose.p - step.p)),
            rotated(inverse_rotation, twist.angular - rate.angular)};
  }
  return {rotated(step.q, twist.linear) + rate.linear + cross(rate.angular, rotated(step.q, pose.p)),
          rotated(step.q, twist.angular) + rate.angular};
}

template <bool kDown, bool kMoving>
COFRAME_INLINE void add_step(const PoseLanes& step, const TwistLanes& rate, bool first, std::size_t i, PoseRows& poses,
                             TwistRows* twists) {
  const Lanes zero{}, one = splat(1.0);
  const PoseLanes pose = first ? PoseLanes{{zero, zero, zero, one}, {zero, zero, zero}} : load(poses, i);
  if constexpr (kMoving) {
    const TwistLanes twist = first ? TwistLanes{{zero, zero, zero}, {zero, zero, zero}} : load(*twists, i);
    store(transformed<kDown>(step, rate, pose, twist), *twists, i);
  }
  store(first && !kDown ? step : transformed<kDown>(step, pose), poses, i);
}

// Computes the pose of the edge for the rows from `i` on, and with kMoving its rate of change in the parent's axes:
// constant along a line for the translation, about one axis for the rotation.
template <bool kMoving>
COFRAME_INLINE PoseLanes step_at(const Between& edge, std::size_t i, TwistLanes& rate) {
  const Lanes t = load_lanes(edge.fraction + i);
  const Quaternion<Lanes> a = load_rotations(edge.older + i), b = load_rotations(edge.newer + i);
  const Lanes product = dot(a, b), sign = sign_of(product);
  const Weights<Lanes> weights = weights_at<kMoving>(t, with_sign(product, sign));
  const Lanes first = weights.first, second = with_sign(weights.second, sign);
  const Ends<Lanes> line = line_weights(t);
  const Vector<Lanes> from = load_translations(edge.older + i), to = load_translations(edge.newer + i);
  if constexpr (kMoving) {
    const Lanes per_second = load_lanes(edge.per_second + i);
    const Quaternion<Lanes> rotation = b * conjugate(a);
    const Lanes scale = with_sign(2.0 * per_second * weights.angle_by_sine, sign);
    rate = {per_second * (to - from), scale * Vector<Lanes>{rotation.x, rotation.y, rotation.z}};
  }
  return {
      {first * a.x + second * b.x, first * a.y + second * b.y, first * a.z + second * b.z, first * a.w + second * b.w},
      line.first * from + line.second * to};
}

// The same for an edge with a constant pose.
template <bool kMoving>
COFRAME_INLINE PoseLanes step_at(const Pose& edge, std::size_t, TwistLanes& rate) {
  rate = {{Lanes{}, Lanes{}, Lanes{}}, {Lanes{}, Lanes{}, Lanes{}}};
  return splat(edge);
}

template <bool kDown, bool kMoving, class Edge>
void follow(const Edge& edge, bool first, std::size_t n, PoseRows& poses, TwistRows* twists) {
  for (std::size_t i = 0; i < n; i += kLanes) {
    TwistLanes rate;
    const PoseLanes step = step_at<kMoving>(edge, i, rate);
    add_step<kDown, kMoving>(step, rate, first, i, poses, twists);
  }
}

template <bool kDown>
void follow_screws(const Between& edge, bool first, std::size_t n, PoseRows& poses) {
  for (std::size_t i = 0; i < n; i += kLanes) {
    const PoseLanes a{load_rotations(edge.older + i), load_translations(edge.older + i)};
    const PoseLanes b{load_rotations(edge.newer + i), load_translations(edge.newer + i)};
    const TwistLanes none{};
    add_step<kDown, false>(along_screw(a, b, load_lanes(edge.fraction + i)), none, first, i, poses, nullptr);
  }
}

// Finds the destinations of kLanes rows from `i` on. Rows beyond the last one are written to `discarded`.
template <std::size_t kWidth>
COFRAME_INLINE void find_destinations(std::size_t i, std::size_t n, const std::size_t* at, double* out,
                                      double* discarded, double** destinations) {
  for (std::size_t k = 0; k < kLanes; ++k) destinations[k] = i + k < n ? out + kWidth * at[i + k] : discarded;
}

}  // namespace

void compose_rows(const Between& edge, bool down, bool first, std::size_t n, PoseRows& poses) {
  (down ? &follow<true, false, Between> : &follow<false, false, Between>)(edge, first, n, poses, nullptr);
}

void compose_rows_along_screws(const Between& edge, bool down, bool first, std::size_t n, PoseRows& poses) {
  (down ? &follow_screws<true> : &follow_screws<false>)(edge, first, n, poses);
}

void compose_constant(const Pose& edge, bool down, bool first, std::size_t n, PoseRows& poses) {
  (down ? &follow<true, false, Pose> : &follow<false, false, Pose>)(edge, first, n, poses, nullptr);
}

void compose_rows_with_twists(const Between& edge, bool down, bool first, std::size_t n, PoseRows& poses,
                              TwistRows& twists) {
  (down ? &follow<true, true, Between> : &follow<false, true, Between>)(edge, first, n, poses, &twists);
}

void compose_constant_with_twists(const Pose& edge, bool down, bool first, std::size_t n, PoseRows& poses,
                                  TwistRows& twists) {
  (down ? &follow<true, true, Pose> : &follow<false, true, Pose>)(edge, first, n, poses, &twists);
}

void write_poses(const PoseRows& poses, std::size_t n, const std::size_t* at, double* out) {
  double discarded[7];
  double* destinations[kLanes];
  for (std::size_t i = 0; i < n; i += kLanes) {
    find_destinations<7>(i, n, at, out, discarded, destinations);
    const PoseLanes pose = load(poses, i);
    const Quaternion<Lanes> q = canonical(pose.q);
    store_columns(pose.p.x, pose.p.y, destinations, 0);
    store_columns(pose.p.z, q.x, destinations, 2);
    store_columns(q.y, q.z, destinations, 4);
    store_columns(q.z, q.w, destinations, 5);
  }
}

void write_twists(const TwistRows& twists, std::size_t n, const std::size_t* at, double* out) {
  double discarded[6];
  double* destinations[kLanes];
  for (std::size_t i = 0; i < n; i += kLanes) {
    find_destinations<6>(i, n, at, out, discarded, destinations);
    const TwistLanes twist = load(twists, i);
    store_columns(twist.linear.x, twist.linear.y, destinations, 0);
    store_columns(twist.linear.z, twist.angular.x, destinations, 2);
    store_columns(twist.angular.y, twist.angular.z, destinations, 4);
  }
}

}  // namespace coframe::COFRAME_LEVEL
