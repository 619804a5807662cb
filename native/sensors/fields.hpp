// SPDX-License-Identifier: Apache-2.0
// The memory layout of the coordinates of points, and a block of coordinates for computations.
#pragma once

#include <cstddef>

#include "kernels/kernels.hpp"

namespace coframe {

// Points in rows, as in an organized cloud. Points are numbered row by row.
struct Grid {
  std::size_t rows, width;
  std::size_t count() const { return rows * width; }
};

// One number of every point.
struct Field {
  char* data;
  std::ptrdiff_t row_step, step;
  Number number;
};

// Three fields that form a vector.
struct Coordinates {
  Field x, y, z;
  bool is_direction;  // rotated but not translated: normals, velocities
};

inline constexpr std::size_t kPointBlock = 128;

// Calls each(columns, n, done) row by row for `count` points from `first` on: n points, after `done` previous ones.
template <class Each>
void for_each_piece(const Coordinates& at, const Grid& grid, std::size_t first, std::size_t count, Each&& each) {
  std::size_t row = grid.rows == 1 ? 0 : first / grid.width, column = first - row * grid.width;
  for (std::size_t done = 0; done < count; ++row, column = 0) {
    const std::size_t n = std::min(grid.width - column, count - done);
    const auto piece = [&](const Field& field) {
      return Column{field.data + static_cast<std::ptrdiff_t>(row) * field.row_step +
                        static_cast<std::ptrdiff_t>(column) * field.step,
                    field.step, field.number};
    };
    each(Columns{piece(at.x), piece(at.y), piece(at.z)}, n, done);
    done += n;
  }
}

// The coordinates of up to kPointBlock consecutive points.
class PointBlock {
 public:
  Points points() { return {x_, y_, z_}; }
  Points points_from(std::size_t i) { return {x_ + i, y_ + i, z_ + i}; }

  void load(const Kernels& kernels, const Coordinates& from, const Grid& grid, std::size_t first, std::size_t count) {
    for_each_piece(from, grid, first, count, [&](const Columns& columns, std::size_t n, std::size_t done) {
      kernels.load(columns, n, points_from(done));
    });
  }
  void store(const Kernels& kernels, const Coordinates& to, const Grid& grid, std::size_t first, std::size_t count) {
    for_each_piece(to, grid, first, count, [&](const Columns& columns, std::size_t n, std::size_t done) {
      kernels.store(columns, n, points_from(done));
    });
  }

 private:
  double x_[kPointBlock], y_[kPointBlock], z_[kPointBlock];
};

inline Affine affine_of(const Pose& pose, bool is_direction) {
  const double x = pose.q[0], y = pose.q[1], z = pose.q[2], w = pose.q[3];
  const double translation_factor = is_direction ? 0.0 : 1.0;
  return {
      {{1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y), translation_factor * pose.p[0]},
       {2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x), translation_factor * pose.p[1]},
       {2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y), translation_factor * pose.p[2]}}};
}

}  // namespace coframe
