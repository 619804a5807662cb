// The loops for one level of the processor; compiled once for each, as COFRAME_LEVEL, with the name COFRAME_LEVEL_NAME:
// without both for the least that the compiler is asked for, as `plain`.
//
// Plain loops over short arrays, which compilers turn into vector instructions. They must not contract products and sums
// (-ffp-contract=off): then all levels round alike. And nothing here may come from a header but plain data and libm: of
// an inline function the linker keeps one copy for the whole program, and it could be this one, with instructions that
// not every processor has.
#include <cmath>
#include <cstring>

#include "kernels/kernels.hpp"

#ifndef COFRAME_LEVEL
#define COFRAME_LEVEL plain
#define COFRAME_LEVEL_NAME "plain"
#endif

#if defined(__GNUC__)
#define COFRAME_INLINE [[gnu::always_inline]] inline  // a call in a loop would keep it from becoming vector instructions
#else
#define COFRAME_INLINE inline
#endif

namespace coframe::COFRAME_LEVEL {

namespace {

// So many values at a time stay in the first cache.
constexpr std::size_t kBlock = 64;

std::size_t block_size(std::size_t left) { return left < kBlock ? left : kBlock; }

// sin(t theta) / sin(theta) as a series of K terms in y = cos(theta) - 1, as in core/pose.hpp.
template <int K, int J = 1>
COFRAME_INLINE double series(double t2, double y) {
  if constexpr (J > K) {
    return 1.0;
  } else {
    constexpr double u = 1.0 / (J * (2.0 * J + 1.0)), v = J / (2.0 * J + 1.0);
    return 1.0 + (t2 * u - v) * y * series<K, J + 1>(t2, y);
  }
}

// What slerp weighs one of two quaternions by whose angle has this cosine, which is not negative. The further they are
// apart, the more it takes; each way is good to 1e-16 down to `kLeast`.
template <int K>
struct Series {
  COFRAME_INLINE static double weight(double t, double cosine) { return t * series<K>(t * t, cosine - 1.0); }
};
struct Nearest : Series<2> {
  static constexpr double kLeast = 1.0 - 1.7e-5;
};
struct Near : Series<4> {
  static constexpr double kLeast = 1.0 - 1.9e-3;
};
struct Middle : Series<8> {
  static constexpr double kLeast = 1.0 - 4.3e-2;
};
// By way of half the angle: sin(2 t phi) / sin(2 phi) = sin(t phi) / sin(phi) * cos(t phi) / cos(phi).
struct Far {
  COFRAME_INLINE static double weight(double t, double cosine) {
    const double half = std::sqrt(0.5 + 0.5 * cosine);
    const double ratio = Series<18>::weight(t, half);
    return ratio * std::sqrt(1.0 - ratio * ratio * (0.5 - 0.5 * cosine)) / half;
  }
};

// Calls `loop` with the shortest way that is good for angles up to that of the cosine `least`.
template <class Loop>
void choose_way(double least, Loop&& loop) {
  if (least > Nearest::kLeast) return loop(Nearest());
  if (least > Near::kLeast) return loop(Near());
  if (least > Middle::kLeast) return loop(Middle());
  loop(Far());
}

struct Arc {
  double cosine, sign;
};

// The shorter of the two arcs between two quaternions: `sign` is that of the second one on it.
COFRAME_INLINE Arc arc(const double* a, const double* b) {
  const double cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  const double sign = cosine < 0.0 ? -1.0 : 1.0;
  const double length = sign * cosine;
  return {length < 1.0 ? length : 1.0, sign};
}

void interpolate_many(const Pose* older, const Pose* newer, const double* shares, std::size_t n, Pose* out) {
  double cosines[kBlock], signs[kBlock];
  for (std::size_t done = 0; done < n; done += kBlock) {
    const std::size_t count = block_size(n - done);
    const Pose *a = older + done, *b = newer + done;
    double least = 1.0;
    for (std::size_t i = 0; i < count; ++i) {
      const Arc between = arc(a[i].q, b[i].q);
      cosines[i] = between.cosine;
      signs[i] = between.sign;
      least = between.cosine < least ? between.cosine : least;
    }
    choose_way(least, [&](auto way) {
      double firsts[kBlock], seconds[kBlock];
      for (std::size_t i = 0; i < count; ++i) {
        const double t = shares[done + i];
        firsts[i] = decltype(way)::weight(1.0 - t, cosines[i]);
        seconds[i] = signs[i] * decltype(way)::weight(t, cosines[i]);
      }
      for (std::size_t i = 0; i < count; ++i) {
        const double t = shares[done + i];
        Pose& result = out[done + i];
        for (int k = 0; k < 4; ++k) result.q[k] = firsts[i] * a[i].q[k] + seconds[i] * b[i].q[k];
        for (int k = 0; k < 3; ++k) result.p[k] = (1.0 - t) * a[i].p[k] + t * b[i].p[k];
      }
    });
  }
}

COFRAME_INLINE std::uint32_t swapped(std::uint32_t v) {
  return v >> 24 | (v >> 8 & 0xff00u) | (v << 8 & 0xff0000u) | v << 24;
}
COFRAME_INLINE std::uint64_t swapped(std::uint64_t v) {
  return static_cast<std::uint64_t>(swapped(static_cast<std::uint32_t>(v))) << 32 |
         swapped(static_cast<std::uint32_t>(v >> 32));
}

// How a number is kept: T, as it is or with its bytes the other way round.
template <class T, class Bits, bool kSwapped>
struct Kept {
  COFRAME_INLINE static double load(const char* data) {
    Bits bits;
    std::memcpy(&bits, data, sizeof(bits));
    if constexpr (kSwapped) bits = swapped(bits);
    T value;
    std::memcpy(&value, &bits, sizeof(value));
    return static_cast<double>(value);
  }
  COFRAME_INLINE static void store(char* data, double number) {
    const T value = static_cast<T>(number);
    Bits bits;
    std::memcpy(&bits, &value, sizeof(bits));
    if constexpr (kSwapped) bits = swapped(bits);
    std::memcpy(data, &bits, sizeof(bits));
  }
};

template <class Loop>
void choose_kept(Number number, Loop&& loop) {
  switch (number) {
    case Number::float32: return loop(Kept<float, std::uint32_t, false>());
    case Number::float64: return loop(Kept<double, std::uint64_t, false>());
    case Number::float32_swapped: return loop(Kept<float, std::uint32_t, true>());
    case Number::float64_swapped: return loop(Kept<double, std::uint64_t, true>());
  }
}

void load(const Column& from, std::size_t n, double* __restrict out) {
  choose_kept(from.number, [&](auto kept) {
    const char* const data = from.data;
    const std::ptrdiff_t step = from.step;
    for (std::size_t i = 0; i < n; ++i) out[i] = kept.load(data + static_cast<std::ptrdiff_t>(i) * step);
  });
}

void store(const Column& to, std::size_t n, const double* __restrict in) {
  choose_kept(to.number, [&](auto kept) {
    char* const data = to.data;
    const std::ptrdiff_t step = to.step;
    for (std::size_t i = 0; i < n; ++i) kept.store(data + static_cast<std::ptrdiff_t>(i) * step, in[i]);
  });
}

Span span(const std::int64_t* times, std::size_t n) {
  std::int64_t first = times[0], last = times[0];
  for (std::size_t i = 0; i < n; ++i) {
    first = times[i] < first ? times[i] : first;
    last = times[i] > last ? times[i] : last;
  }
  return {first, last};
}

std::size_t changes(const std::int64_t* times, std::size_t n) {
  std::size_t count = 0;
  for (std::size_t i = 1; i < n; ++i) count += times[i] != times[i - 1] ? 1 : 0;
  return count;
}

void shares(const std::int64_t* times, std::int64_t start, std::int64_t end, std::size_t n, double* out) {
  const auto origin = static_cast<std::uint64_t>(start);
  const std::uint64_t whole = static_cast<std::uint64_t>(end) - origin;
  const double scale = 1.0 / static_cast<double>(whole);
  constexpr std::uint64_t kExact = std::uint64_t{1} << 52;
  if (whole >= kExact) {
    for (std::size_t i = 0; i < n; ++i) {
      out[i] = static_cast<double>(static_cast<std::uint64_t>(times[i]) - origin) * scale;
    }
    return;
  }
  // An integer below 2^52 in the fraction of 2^52: few processors convert 64-bit integers many at a time.
  constexpr std::uint64_t kBits = 0x4330000000000000;
  constexpr double kValue = 4503599627370496.0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint64_t bits = (static_cast<std::uint64_t>(times[i]) - origin) | kBits;
    double value;
    std::memcpy(&value, &bits, sizeof(value));
    out[i] = (value - kValue) * scale;
  }
}

void transform(const Affine& affine, std::size_t n, Points points) {
  double m[3][4];
  std::memcpy(m, affine.m, sizeof(m));
  double *__restrict xs = points.x, *__restrict ys = points.y, *__restrict zs = points.z;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = xs[i], y = ys[i], z = zs[i];
    xs[i] = m[0][0] * x + m[0][1] * y + m[0][2] * z + m[0][3];
    ys[i] = m[1][0] * x + m[1][1] * y + m[1][2] * z + m[1][3];
    zs[i] = m[2][0] * x + m[2][1] * y + m[2][2] * z + m[2][3];
  }
}

struct Vector {
  double x, y, z;
};

// v + 2 w (u x v) + 2 u x (u x v), u the vector part.
COFRAME_INLINE Vector rotated(double qx, double qy, double qz, double qw, const Vector& v) {
  const double tx = 2.0 * (qy * v.z - qz * v.y);
  const double ty = 2.0 * (qz * v.x - qx * v.z);
  const double tz = 2.0 * (qx * v.y - qy * v.x);
  return {v.x + qw * tx + (qy * tz - qz * ty), v.y + qw * ty + (qz * tx - qx * tz),
          v.z + qw * tz + (qx * ty - qy * tx)};
}

// One point seen from the other end of a link whose pose is q, p.
template <bool kInverse>
COFRAME_INLINE Vector seen(double qx, double qy, double qz, double qw, double px, double py, double pz, const Vector& v) {
  if constexpr (kInverse) return rotated(-qx, -qy, -qz, qw, {v.x - px, v.y - py, v.z - pz});
  const Vector turned = rotated(qx, qy, qz, qw, v);
  return {turned.x + px, turned.y + py, turned.z + pz};
}

template <bool kInverse, class Way>
void transform_moving_by(const Motion& motion, const Arc& between, const double* __restrict shares, std::size_t n,
                         const Points& points) {
  double aq[4], bq[4], ap[3], bp[3];
  std::memcpy(aq, motion.older.q, sizeof(aq));
  std::memcpy(ap, motion.older.p, sizeof(ap));
  std::memcpy(bp, motion.newer.p, sizeof(bp));
  for (int k = 0; k < 4; ++k) bq[k] = between.sign * motion.newer.q[k];
  const double cosine = between.cosine;
  double *__restrict xs = points.x, *__restrict ys = points.y, *__restrict zs = points.z;
  for (std::size_t i = 0; i < n; ++i) {
    const double t = shares[i], rest = 1.0 - t;
    const double a = Way::weight(rest, cosine), b = Way::weight(t, cosine);
    const Vector point =
        seen<kInverse>(a * aq[0] + b * bq[0], a * aq[1] + b * bq[1], a * aq[2] + b * bq[2], a * aq[3] + b * bq[3],
                       rest * ap[0] + t * bp[0], rest * ap[1] + t * bp[1], rest * ap[2] + t * bp[2],
                       {xs[i], ys[i], zs[i]});
    xs[i] = point.x;
    ys[i] = point.y;
    zs[i] = point.z;
  }
}

void transform_moving(const Motion& motion, const double* shares, std::size_t n, Points points) {
  const Arc between = arc(motion.older.q, motion.newer.q);
  choose_way(between.cosine, [&](auto way) {
    using Way = decltype(way);
    if (motion.inverse) {
      transform_moving_by<true, Way>(motion, between, shares, n, points);
    } else {
      transform_moving_by<false, Way>(motion, between, shares, n, points);
    }
  });
}

template <bool kInverse>
void transform_each_by(const Pose* poses, std::size_t n, const Points& points) {
  double *__restrict xs = points.x, *__restrict ys = points.y, *__restrict zs = points.z;
  for (std::size_t i = 0; i < n; ++i) {
    const double *q = poses[i].q, *p = poses[i].p;
    const Vector point = seen<kInverse>(q[0], q[1], q[2], q[3], p[0], p[1], p[2], {xs[i], ys[i], zs[i]});
    xs[i] = point.x;
    ys[i] = point.y;
    zs[i] = point.z;
  }
}

void transform_each(const Pose* poses, bool inverse, std::size_t n, Points points) {
  if (inverse) {
    transform_each_by<true>(poses, n, points);
  } else {
    transform_each_by<false>(poses, n, points);
  }
}

}  // namespace

extern const Kernels table;
const Kernels table{COFRAME_LEVEL_NAME, &interpolate_many, &load,      &store,           &span, &changes,
                    &shares,            &transform,        &transform_moving, &transform_each};

}  // namespace coframe::COFRAME_LEVEL
