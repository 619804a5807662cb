// SPDX-License-Identifier: Apache-2.0
// The error between two samples: along an edge, both the original and the thinned translation are piecewise linear, and
// their distance is convex between the stamps of samples. It is therefore largest at the stamp of a dropped sample,
// where it is checked.
//
// Rotations are piecewise great arcs on the sphere of unit quaternions, whose distance can be larger between two stamps
// than at both, because arcs bulge. Move one arc to the other one by moving its ends along great arcs: each point of it
// follows a Jacobi field of the sphere, which is at most 1 / cos(h / 2) times as long as at the ends for an arc of
// length h. The rotation of an arc is 2 h. A sample that is rotated by more than 90 degrees against its predecessor is
// always sent, and so is the predecessor; all other arcs grow to at most 90 degrees + 2 * angle on the way. So it is
// enough to check against `angle` times the cosine of a quarter of that. MaxError::kMaxAngle keeps all arcs shorter
// than 180 degrees, where the shorter arc is unique.
#include "core/thinning.hpp"

#include <algorithm>
#include <cmath>

#include "core/interpolation.hpp"

namespace coframe {
namespace {

constexpr Stamp kCacheLength = 10'000'000'000;  // of tf2: buffers drop transforms that are older than that
constexpr double kQuarterTurn = 1.5707963267948966;

double distance_between(const double* a, const double* b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

// The angle of the rotation from a to b, up to half a turn. The chord is exact for small angles, unlike the cosine.
double angle_between(const double* a, const double* b) {
  double near = 0.0, far = 0.0;  // the squared chords to b and -b
  for (int i = 0; i < 4; ++i) {
    near += (a[i] - b[i]) * (a[i] - b[i]);
    far += (a[i] + b[i]) * (a[i] + b[i]);
  }
  return 4.0 * std::asin(std::min(1.0, 0.5 * std::sqrt(std::min(near, far))));
}

bool is_near(const MaxError& max_error, const Pose& a, const Pose& b) {
  return distance_between(a.p, b.p) <= max_error.distance && angle_between(a.q, b.q) <= max_error.angle;
}

Pose to_pose(const TransformValues& values) {
  Pose pose;
  for (int i = 0; i < 3; ++i) pose.p[i] = values.translation[i];
  for (int i = 0; i < 4; ++i) pose.q[i] = values.rotation[i];
  canonicalise(pose.q);
  return pose;
}

}  // namespace

bool Thinning::add(const MaxError& max_error, const TimedTransform& transform, std::vector<TimedTransform>& due) {
  const Sample sample{transform, to_pose(transform.values)};
  if (!is_started_) {
    is_started_ = true;
    send(sample, due);
    return false;
  }
  const Sample& previous = pending_.empty() ? last_ : pending_.back();
  if (transform.stamp <= previous.transform.stamp) {
    const bool is_repeated = transform.stamp == previous.transform.stamp && is_near({}, sample.pose, previous.pose);
    if (!is_repeated) add_late(sample, due);
    return !is_repeated;
  }
  const bool is_leap = angle_between(previous.pose.q, sample.pose.q) > kQuarterTurn;
  const bool is_close = !is_leap && fits(max_error, sample);
  if (!pending_.empty() && (!is_close || pending_.size() >= kMaxPending)) send(pending_.back(), due);
  const bool is_moving = !is_close || !is_near(max_error, last_.pose, sample.pose);
  if (is_leap) {
    send(sample, due);
  } else {
    pending_.push_back(sample);
  }
  return is_moving;
}

void Thinning::flush(std::vector<TimedTransform>& due) {
  if (!pending_.empty()) send(pending_.back(), due);
}

void Thinning::restart() {
  std::vector<Sample>().swap(pending_);
  is_started_ = false;
}

// Whether all pending samples are close to the interpolation between the last sent sample and the newest one.
bool Thinning::fits(const MaxError& max_error, const Sample& newest) const {
  const MaxError reduced_error{max_error.distance,
                               max_error.angle * std::cos(0.25 * (kQuarterTurn + 2.0 * max_error.angle))};
  const Stamp start = last_.transform.stamp;
  const auto duration = static_cast<double>(newest.transform.stamp - start);
  for (const Sample& sample : pending_) {
    Pose expected;
    interpolate(last_.pose, newest.pose, static_cast<double>(sample.transform.stamp - start) / duration, expected);
    if (!is_near(reduced_error, expected, sample.pose)) return false;
  }
  return true;
}

// An equal or older stamp changes what is between samples that were already checked, so these are sent as well.
void Thinning::add_late(const Sample& sample, std::vector<TimedTransform>& due) {
  for (const Sample& each : pending_) due.push_back(each.transform);
  if (!pending_.empty()) last_ = pending_.back();
  std::vector<Sample>().swap(pending_);
  due.push_back(sample.transform);
  // Interpolation continues from the newest sample, unless the clock was set back.
  const Stamp lateness = last_.transform.stamp - sample.transform.stamp;
  if (lateness == 0 || lateness > kCacheLength) last_ = sample;
}

void Thinning::send(const Sample& sample, std::vector<TimedTransform>& due) {
  due.push_back(sample.transform);
  last_ = sample;
  std::vector<Sample>().swap(pending_);  // frees the memory: there can be many edges
}

}  // namespace coframe
