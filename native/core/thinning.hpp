// SPDX-License-Identifier: Apache-2.0
// Thins the transforms of one edge: decides which samples must be sent so that interpolation between the sent ones
// stays within a given error of interpolation between all of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/pose.hpp"
#include "core/tree.hpp"

namespace coframe {

// How far an interpolated transform of an edge may be from the original one.
struct MaxError {
  double distance = 0.0;  // meters
  double angle = 0.0;     // radians

  static constexpr double kMaxAngle = 0.7853981633974483;  // 45 degrees, see thinning.cpp
};

// A transform, and the time at which it arrived.
struct TimedTransform {
  Stamp stamp = 0;
  std::int64_t arrived = 0;  // nanoseconds of any monotonic clock
  TransformValues values{};
};

// The samples of an edge since the last one that was sent. The method is an opening window: a sample stays pending as
// long as the interpolation from the last sent sample to the newest one is close to all samples between them. When it
// is not, the sample before the newest one is sent. Equal or older stamps are sent immediately, with all pending
// samples.
class Thinning {
 public:
  // Limits the time that add() takes, and the memory.
  static constexpr std::size_t kMaxPending = 64;

  // Adds a sample, and appends to `due` those that must be sent now. Returns whether the edge moves: its newest sample
  // differs from the last sent one by more than the allowed error.
  bool add(const MaxError& max_error, const TimedTransform& transform, std::vector<TimedTransform>& due);
  // Appends the newest sample to `due` if it is pending. All other pending samples are dropped.
  void flush(std::vector<TimedTransform>& due);
  // The next sample is sent immediately, because interpolation from earlier ones does not apply to it.
  void restart();

  std::size_t pending() const { return pending_.size(); }
  // When the last sample that was sent had arrived.
  std::int64_t sent_at() const { return last_.transform.arrived; }

 private:
  struct Sample {
    TimedTransform transform;
    Pose pose;
  };

  bool fits(const MaxError& max_error, const Sample& newest) const;
  void send(const Sample& sample, std::vector<TimedTransform>& due);
  void add_late(const Sample& sample, std::vector<TimedTransform>& due);

  Sample last_;                  // the last sent sample, if there is one
  std::vector<Sample> pending_;  // later ones, in the order of their stamps
  bool is_started_ = false;
};

}  // namespace coframe
