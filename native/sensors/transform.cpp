// SPDX-License-Identifier: Apache-2.0
#include "sensors/transform.hpp"

#include "core/parts.hpp"

namespace coframe {

void transform_points(const Pose& pose, const Grid& grid, const std::vector<Coordinates>& coordinates,
                      unsigned threads) {
  const Kernels& kernels = coframe::kernels();
  in_parts(grid.count(), kPointBlock, threads, [&](std::size_t begin, std::size_t end) {
    for (const Coordinates& each : coordinates) {
      const Affine affine = affine_of(pose, each.is_direction);
      for_each_piece(each, grid, begin, end - begin, [&](const Columns& columns, std::size_t n, std::size_t) {
        kernels.transform_columns(affine, n, columns);
      });
    }
  });
}

}  // namespace coframe
