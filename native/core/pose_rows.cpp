#include "core/pose_rows.hpp"

#include <algorithm>
#include <cmath>

// One copy a level of x86-64, chosen as the library is loaded.
#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_THREAD__) && !defined(__SANITIZE_ADDRESS__)
#define COFRAME_CPU_LEVELS __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define COFRAME_CPU_LEVELS
#endif

namespace coframe {

namespace {

// The weights of both ends, by series (see slerp_weights in pose.hpp).
template <int K>
inline void weigh_rows(const double* y, const double* share, std::size_t count, double* first, double* second) {
  for (std::size_t i = 0; i < count; ++i) {
    first[i] = slerp_weight_series<K>(1.0 - share[i], y[i]);
    second[i] = slerp_weight_series<K>(share[i], y[i]);
  }
}

// Seen from the parent: q q_pose, R p_pose + p.
inline void compose_up(const double* q, const double* p, double* pose_q, double* pose_p) {
  double turned[4], moved[3];
  multiply(q, pose_q, turned);
  rotate(q, pose_p, moved);
  for (int k = 0; k < 4; ++k) pose_q[k] = turned[k];
  for (int k = 0; k < 3; ++k) pose_p[k] = moved[k] + p[k];
}

// Seen from the child: q* q_pose, R* (p_pose - p).
inline void compose_down(const double* q, const double* p, double* pose_q, double* pose_p) {
  const double inverse[4] = {-q[0], -q[1], -q[2], q[3]};
  double turned[4], moved[3];
  for (int k = 0; k < 3; ++k) pose_p[k] -= p[k];
  multiply(inverse, pose_q, turned);
  rotate(inverse, pose_p, moved);
  for (int k = 0; k < 4; ++k) pose_q[k] = turned[k];
  for (int k = 0; k < 3; ++k) pose_p[k] = moved[k];
}

// `step_at` gives the numbers of a row's step.
template <bool Down, class StepAt>
inline void compose_each(StepAt&& step_at, std::size_t count, PoseRows& poses) {
  for (std::size_t i = 0; i < count; ++i) {
    double q[4], p[3], pose_q[4], pose_p[3];
    step_at(i, q, p);
    for (int k = 0; k < 4; ++k) pose_q[k] = poses.q[k][i];
    for (int k = 0; k < 3; ++k) pose_p[k] = poses.p[k][i];
    if constexpr (Down) {
      compose_down(q, p, pose_q, pose_p);
    } else {
      compose_up(q, p, pose_q, pose_p);
    }
    for (int k = 0; k < 4; ++k) poses.q[k][i] = pose_q[k];
    for (int k = 0; k < 3; ++k) poses.p[k][i] = pose_p[k];
  }
}

}  // namespace

void PoseRows::set_identity(std::size_t count) {
  for (int k = 0; k < 4; ++k) std::fill_n(q[k], count, k == 3 ? 1.0 : 0.0);
  for (int k = 0; k < 3; ++k) std::fill_n(p[k], count, 0.0);
}

COFRAME_CPU_LEVELS
void interpolate_rows(const PoseRows& older, const PoseRows& newer, const double* part, const double* whole,
                      std::size_t count, PoseRows& out) {
  alignas(64) double share[kBlock], y[kBlock], sign[kBlock], first[kBlock], second[kBlock];
  int beyond_short = 0, beyond_long = 0;
  for (std::size_t i = 0; i < count; ++i) {
    double cosine = 0.0;
    for (int k = 0; k < 4; ++k) cosine += older.q[k][i] * newer.q[k][i];
    sign[i] = cosine < 0.0 ? -1.0 : 1.0;
    y[i] = std::min(sign[i] * cosine, 1.0) - 1.0;
    share[i] = part[i] / whole[i];
    beyond_short += y[i] <= kShortSeries;
    beyond_long += y[i] <= kLongSeries;
  }
  if (beyond_short == 0) {
    weigh_rows<4>(y, share, count, first, second);
  } else {
    weigh_rows<8>(y, share, count, first, second);
  }
  for (std::size_t i = 0; beyond_long > 0 && i < count; ++i) {
    if (y[i] <= kLongSeries) slerp_weights(1.0 + y[i], share[i], first[i], second[i]);
  }
  for (std::size_t i = 0; i < count; ++i) {
    for (int k = 0; k < 4; ++k) out.q[k][i] = first[i] * older.q[k][i] + sign[i] * second[i] * newer.q[k][i];
    for (int k = 0; k < 3; ++k) out.p[k][i] = (1.0 - share[i]) * older.p[k][i] + share[i] * newer.p[k][i];
  }
}

COFRAME_CPU_LEVELS
void compose_rows(const PoseRows& steps, bool down, std::size_t count, PoseRows& poses) {
  const auto step_at = [&steps](std::size_t i, double* q, double* p) {
    for (int k = 0; k < 4; ++k) q[k] = steps.q[k][i];
    for (int k = 0; k < 3; ++k) p[k] = steps.p[k][i];
  };
  if (down) {
    compose_each<true>(step_at, count, poses);
  } else {
    compose_each<false>(step_at, count, poses);
  }
}

COFRAME_CPU_LEVELS
void compose_rows(const Pose& step, bool down, std::size_t count, PoseRows& poses) {
  const auto step_at = [&step](std::size_t, double* q, double* p) {
    for (int k = 0; k < 4; ++k) q[k] = step.q[k];
    for (int k = 0; k < 3; ++k) p[k] = step.p[k];
  };
  if (down) {
    compose_each<true>(step_at, count, poses);
  } else {
    compose_each<false>(step_at, count, poses);
  }
}

COFRAME_CPU_LEVELS
void canonicalise_rows(std::size_t count, PoseRows& poses) {
  for (std::size_t i = 0; i < count; ++i) {
    const double x = poses.q[0][i], y = poses.q[1][i], z = poses.q[2][i], w = poses.q[3][i];
    const double x2 = x * x, y2 = y * y, z2 = z * z, length2 = x2 + y2 + z2 + w * w;
    double leading = x2 < y2 ? (y2 < z2 ? z : y) : (x2 < z2 ? z : x);
    leading = 4.0 * w * w <= length2 ? leading : w;
    const double scale = (leading < 0.0 ? -1.0 : 1.0) / std::sqrt(length2);
    for (int k = 0; k < 4; ++k) poses.q[k][i] *= scale;
  }
}

}  // namespace coframe
