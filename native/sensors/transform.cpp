#include "sensors/transform.hpp"

namespace coframe {

void transform_points(const Pose& pose, const Grid& grid, const std::vector<Coordinates>& coordinates,
                      unsigned threads) {
  const Kernels& kernels = coframe::kernels();
  in_parts(grid.count(), threads, [&](std::size_t begin, std::size_t end) {
    PointBlock block;
    for (std::size_t first = begin; first < end; first += kPointBlock) {
      const std::size_t count = std::min(kPointBlock, end - first);
      for (const Coordinates& each : coordinates) {
        block.load(kernels, each, grid, first, count);
        kernels.transform(affine_of(pose, each.is_direction), count, block.points());
        block.store(kernels, each, grid, first, count);
      }
    }
  });
}

}  // namespace coframe
