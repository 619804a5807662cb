// SPDX-License-Identifier: Apache-2.0
#include "kernels/lie.hpp"

#include "kernels/arc.hpp"

namespace coframe::COFRAME_LEVEL {

namespace {

COFRAME_INLINE PoseLanes normalized(const PoseLanes& pose) {
  const Lanes scale = 1.0 / root(dot(pose.q, pose.q));
  return {{scale * pose.q.x, scale * pose.q.y, scale * pose.q.z, scale * pose.q.w}, pose.p};
}

template <bool kInverse>
void compose_batches_by(const PoseBatch& a, const PoseBatch& b, std::size_t n, double* out) {
  for (std::size_t i = 0; i < n; i += kLanes) {
    write(normalized(transformed<kInverse>(load(a, i, n), load(b, i, n))), i, n, out);
  }
}

COFRAME_INLINE TwistLanes load_twists(const double* twists, std::size_t i, std::size_t n) {
  const double* rows[kLanes];
  for (std::size_t k = 0; k < kLanes; ++k) rows[k] = twists + 6 * row_at(i, k, n);
  TwistLanes twist;
  load_columns(rows, 0, twist.linear.x, twist.linear.y);
  load_columns(rows, 2, twist.linear.z, twist.angular.x);
  load_columns(rows, 4, twist.angular.y, twist.angular.z);
  return twist;
}

COFRAME_INLINE Lanes load_fractions(const Fractions& fractions, std::size_t i, std::size_t n) {
  if (fractions.step == 0) return splat(fractions.numbers[0]);
  if (i + kLanes <= n) return load_lanes(fractions.numbers + i);
  double numbers[kLanes];
  for (std::size_t k = 0; k < kLanes; ++k) numbers[k] = fractions.numbers[row_at(i, k, n)];
  return load_lanes(numbers);
}

COFRAME_INLINE PoseLanes along_line(const PoseLanes& a, const PoseLanes& b, const Lanes& t) {
  const Ends<Lanes> line = line_weights(t);
  const Vector<Lanes> p = line.first * a.p + line.second * b.p;
  if (!all_above(t, -1e-300) || !all_above(Lanes(1.0 - t), -1e-300)) {  // the weights are for fractions of the arc
    const Vector<Lanes> origin{Lanes{}, Lanes{}, Lanes{}};
    return {along_screw({a.q, origin}, {b.q, origin}, t).q, p};
  }
  const Lanes product = dot(a.q, b.q), sign = sign_of(product), cosine = with_sign(product, sign);
  const Lanes one = splat(1.0);
  const Weights<Lanes> weights = weights_at<false>(t, Lanes(cosine < one ? cosine : one));
  const Lanes first = weights.first, second = with_sign(weights.second, sign);
  return {{first * a.q.x + second * b.q.x, first * a.q.y + second * b.q.y, first * a.q.z + second * b.q.z,
           first * a.q.w + second * b.q.w},
          p};
}

template <bool kScrew>
void interpolate_batches_by(const PoseBatch& a, const PoseBatch& b, const Fractions& fractions, std::size_t n,
                            double* out) {
  for (std::size_t i = 0; i < n; i += kLanes) {
    const PoseLanes from = load(a, i, n), to = load(b, i, n);
    const Lanes t = load_fractions(fractions, i, n);
    write(normalized(kScrew ? along_screw(from, to, t) : along_line(from, to, t)), i, n, out);
  }
}

}  // namespace

void compose_batches(const PoseBatch& a, const PoseBatch& b, bool inverse, std::size_t n, double* out) {
  (inverse ? &compose_batches_by<true> : &compose_batches_by<false>)(a, b, n, out);
}

void exponentials(const double* twists, std::size_t n, double* out) {
  for (std::size_t i = 0; i < n; i += kLanes) write(normalized(exponential(load_twists(twists, i, n))), i, n, out);
}

void logarithms(const PoseBatch& poses, std::size_t n, double* out) {
  for (std::size_t i = 0; i < n; i += kLanes) write(logarithm(load(poses, i, n)), i, n, out);
}

void interpolate_batches(const PoseBatch& a, const PoseBatch& b, const Fractions& fractions, bool screw, std::size_t n,
                         double* out) {
  (screw ? &interpolate_batches_by<true> : &interpolate_batches_by<false>)(a, b, fractions, n, out);
}

}  // namespace coframe::COFRAME_LEVEL
