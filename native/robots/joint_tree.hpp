// SPDX-License-Identifier: Apache-2.0
// Forward kinematics: a tree of joints and the poses of its links for many configurations. Joints are numbers, not
// names.
#pragma once

#include <cstddef>
#include <vector>

#include "kernels/kernels.hpp"

namespace coframe {

struct JointDescription {
  JointKind kind = JointKind::fixed;
  std::ptrdiff_t parent = -1;        // the joint whose child is this joint's parent link; -1: the root link
  Pose origin;                       // with a unit quaternion
  double axis[3] = {0.0, 0.0, 1.0};  // unit vector; for planar joints the normal of the plane
  std::ptrdiff_t mimicked = -1;      // the joint that it mimics as multiplier * position + offset; -1: none
  double multiplier = 1.0, offset = 0.0;
};

// The positions of a joint in many configurations. Steps are in bytes: `step` from one configuration to the next, 0 if
// all have the same position; `number_step` from one number of a position to the next. No data: the joint is not given.
struct JointPositions {
  const char* data = nullptr;
  std::ptrdiff_t step = 0, number_step = 0;
};

// Returns the number of values in the position of a joint.
std::size_t position_size(JointKind kind);

class JointTree {
 public:
  // Parents must come before their children. Throws std::invalid_argument if they do not, or if joints mimic each other
  // in a circle.
  explicit JointTree(const std::vector<JointDescription>& joints);

  std::size_t size() const { return nodes_.size(); }
  JointKind kind(std::size_t joint) const { return nodes_[joint].motion.kind; }

  // Computes the pose of each joint's child link relative to the root link or to its parent link: x, y, z, qx, qy, qz,
  // qw of joint j in configuration i at out + 7 * (j * n + i). Joints that are not given follow the joint that they
  // mimic or are at 0. Returns the first joint with an invalid position (not finite, or a zero quaternion); size() if
  // there is none. The work is divided between `threads` threads.
  std::size_t poses(const std::vector<JointPositions>& given, std::size_t n, bool in_root, unsigned threads,
                    double* out) const;

 private:
  struct Node {
    JointMotion motion;
    std::ptrdiff_t parent, mimicked;
    double multiplier, offset;
    bool is_parent;
    std::size_t slot;  // index of a parent's rows while its children are computed
  };
  // The given positions that determine the position of a joint: multiplier * given + offset; null: only `offset`.
  struct PositionSource {
    const JointPositions* from;
    double multiplier, offset;
  };

  // The arguments of poses(). Each thread processes a part of the configurations.
  struct Work {
    const std::vector<JointPositions>& given;
    std::size_t n;
    bool in_root;
    double* out;
  };

  std::size_t poses_of_part(const Work& work, std::size_t first, std::size_t last) const;
  PositionSource position_source(std::size_t joint, const std::vector<JointPositions>& given) const;
  bool read(std::size_t joint, const std::vector<JointPositions>& given, std::size_t first, std::size_t n,
            double (*columns)[kRowBlock]) const;
  void check_mimicked() const;
  void order_depth_first();

  std::vector<Node> nodes_;
  std::vector<std::size_t> order_;  // depth first, so that few rows are needed at a time
  std::size_t slot_count_ = 0;
};

}  // namespace coframe
