// SPDX-License-Identifier: Apache-2.0
#include "robots/joint_tree.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <memory>
#include <stdexcept>

#include "core/parts.hpp"

namespace coframe {

namespace {

// The number of configurations that are processed together. With the rows of the parent links, they fit the first-level
// cache.
constexpr std::size_t kBlock = 64;
static_assert(kBlock <= kRowBlock);

// Computes two axes of the plane that is normal to `axis`: the shortest rotation from z to `axis`, applied to x and y.
void plane_axes(const double* axis, double* x, double* y) {
  const double half[4] = {-axis[1], axis[0], 0.0, 1.0 + axis[2]};
  const double length = std::sqrt(dot(half, half));
  double upright[4] = {1.0, 0.0, 0.0, 0.0};  // for -z there is no shortest rotation
  if (length > 1e-12) std::transform(half, half + 4, upright, [length](double value) { return value / length; });
  const double along_x[3] = {1.0, 0.0, 0.0}, along_y[3] = {0.0, 1.0, 0.0};
  rotate(upright, along_x, x);
  rotate(upright, along_y, y);
}

JointMotion motion_of(const JointDescription& joint) {
  JointMotion motion{joint.kind, joint.origin, {}, {}};
  const double turn[4] = {joint.axis[0], joint.axis[1], joint.axis[2], 0.0};
  multiply(joint.origin.q, turn, motion.half_turn);
  double directions[2][3] = {{joint.axis[0], joint.axis[1], joint.axis[2]}, {0.0, 0.0, 0.0}};
  if (joint.kind == JointKind::planar) plane_axes(joint.axis, directions[0], directions[1]);
  for (int i = 0; i < 2; ++i) rotate(joint.origin.q, directions[i], motion.directions[i]);
  return motion;
}

// Copies numbers that are `step` bytes apart.
void gather(const char* data, std::ptrdiff_t step, std::size_t n, double* out) {
  if (step == sizeof(double)) {
    std::memcpy(out, data, n * sizeof(double));
    return;
  }
  for (std::size_t i = 0; i < n; ++i)
    std::memcpy(out + i, data + static_cast<std::ptrdiff_t>(i) * step, sizeof(double));
}

// Normalizes quaternions; returns false if one is zero.
bool normalize(double (*columns)[kRowBlock], std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    double largest = 0.0, squares = 0.0;
    for (int k = 0; k < 4; ++k) largest = std::max(largest, std::abs(columns[k][i]));
    if (largest == 0.0) return false;
    for (int k = 0; k < 4; ++k) {
      columns[k][i] /= largest;
      squares += columns[k][i] * columns[k][i];
    }
    const double length = std::sqrt(squares);
    for (int k = 0; k < 4; ++k) columns[k][i] /= length;
  }
  return true;
}

}  // namespace

std::size_t position_size(JointKind kind) {
  switch (kind) {
    case JointKind::fixed: return 0;
    case JointKind::planar: return 3;
    case JointKind::floating: return 7;
    default: return 1;
  }
}

JointTree::JointTree(const std::vector<JointDescription>& joints) {
  for (const JointDescription& joint : joints) {
    const auto before = static_cast<std::ptrdiff_t>(nodes_.size());
    if (joint.parent < -1 || joint.parent >= before) {
      throw std::invalid_argument("A joint comes before the joint of its parent link. Sort them from the root link.");
    }
    nodes_.push_back({motion_of(joint), joint.parent, joint.mimicked, joint.multiplier, joint.offset, false, 0});
  }
  check_mimicked();
  order_depth_first();
}

void JointTree::check_mimicked() const {
  const auto count = static_cast<std::ptrdiff_t>(size());
  for (const Node& node : nodes_) {
    std::ptrdiff_t steps = 0;
    for (const Node* at = &node; at->mimicked != -1; at = &nodes_[static_cast<std::size_t>(at->mimicked)]) {
      if (at->mimicked < 0 || at->mimicked >= count) {
        throw std::invalid_argument("A joint mimics a joint that does not exist.");
      }
      if (++steps > count) throw std::invalid_argument("Joints mimic each other in a circle.");
      const Node& mimicked = nodes_[static_cast<std::size_t>(at->mimicked)];
      if (position_size(at->motion.kind) != 1 || position_size(mimicked.motion.kind) != 1) {
        throw std::invalid_argument("A joint mimics another one, but not both have exactly one position value.");
      }
    }
  }
}

// Orders the joints depth first. The rows of a link are reused after its last child has been computed.
void JointTree::order_depth_first() {
  std::vector<std::vector<std::size_t>> children(size() + 1);
  for (std::size_t j = size(); j-- > 0;) children[static_cast<std::size_t>(nodes_[j].parent + 1)].push_back(j);
  std::vector<std::size_t> pending = children[0], children_left(size()), free_slots;
  for (std::size_t j = 0; j < size(); ++j) children_left[j] = children[j + 1].size();
  while (!pending.empty()) {
    const std::size_t joint = pending.back();
    pending.pop_back();
    order_.push_back(joint);
    const std::ptrdiff_t parent = nodes_[joint].parent;
    if (parent >= 0 && --children_left[static_cast<std::size_t>(parent)] == 0) {
      free_slots.push_back(nodes_[static_cast<std::size_t>(parent)].slot);
    }
    nodes_[joint].is_parent = children_left[joint] > 0;
    if (nodes_[joint].is_parent) {
      if (free_slots.empty()) free_slots.push_back(slot_count_++);
      nodes_[joint].slot = free_slots.back();
      free_slots.pop_back();
    }
    pending.insert(pending.end(), children[joint + 1].begin(), children[joint + 1].end());
  }
}

JointTree::PositionSource JointTree::position_source(std::size_t joint,
                                                     const std::vector<JointPositions>& given) const {
  PositionSource found{nullptr, 1.0, 0.0};
  for (;;) {
    if (given[joint].data) found.from = &given[joint];
    if (found.from || nodes_[joint].mimicked < 0) return found;
    found.offset += found.multiplier * nodes_[joint].offset;
    found.multiplier *= nodes_[joint].multiplier;
    joint = static_cast<std::size_t>(nodes_[joint].mimicked);
  }
}

// Reads the positions of configurations from `first` on into columns. Values beyond the last configuration, up to a
// whole group of lanes, are set to 0. Returns false if a quaternion is zero.
bool JointTree::read(std::size_t joint, const std::vector<JointPositions>& given, std::size_t first, std::size_t n,
                     double (*columns)[kRowBlock]) const {
  const JointKind kind = nodes_[joint].motion.kind;
  const std::size_t size = position_size(kind);
  if (size == 0) return true;
  const std::size_t end = std::min(kRowBlock, n + kMaxLanes);
  const PositionSource source = position_source(joint, given);
  for (std::size_t k = 0; k < size; ++k) {
    std::fill(columns[k] + (source.from ? n : 0), columns[k] + end, 0.0);
    if (!source.from) continue;
    const char* start = source.from->data + static_cast<std::ptrdiff_t>(k) * source.from->number_step;
    gather(start + static_cast<std::ptrdiff_t>(first) * source.from->step, source.from->step, n, columns[k]);
  }
  if (kind == JointKind::floating) {
    if (!source.from) std::fill(columns[6], columns[6] + end, 1.0);
    return normalize(columns + 3, n);
  }
  if (size == 1 && (source.multiplier != 1.0 || source.offset != 0.0)) {
    for (std::size_t i = 0; i < end; ++i) columns[0][i] = source.multiplier * columns[0][i] + source.offset;
  }
  return true;
}

std::size_t JointTree::poses(const std::vector<JointPositions>& given, std::size_t n, bool in_root, unsigned threads,
                             double* out) const {
  const Work work{given, n, in_root, out};
  std::atomic<std::size_t> invalid = size();
  in_parts(n, kBlock, threads, [&](std::size_t first, std::size_t last) {
    const std::size_t found = poses_of_part(work, first, last);
    if (found != size()) invalid = found;
  });
  return invalid;
}

std::size_t JointTree::poses_of_part(const Work& work, std::size_t first, std::size_t last) const {
  const std::unique_ptr<PoseRows[]> rows(new PoseRows[slot_count_]);
  alignas(64) double columns[7][kRowBlock];
  const Kernels& kernel = kernels();
  for (; first < last; first += kBlock) {
    const std::size_t count = std::min(kBlock, last - first);
    for (const std::size_t joint : order_) {
      const Node& node = nodes_[joint];
      const PoseRows* parents =
          work.in_root && node.parent >= 0 ? &rows[nodes_[static_cast<std::size_t>(node.parent)].slot] : nullptr;
      PoseRows* poses = work.in_root && node.is_parent ? &rows[node.slot] : nullptr;
      double* out = work.out + 7 * (joint * work.n + first);
      if (!read(joint, work.given, first, count, columns) ||
          !kernel.compute_joint_poses(node.motion, columns, count, parents, poses, out)) {
        return joint;
      }
    }
  }
  return size();
}

}  // namespace coframe
