// SPDX-License-Identifier: Apache-2.0
// A tree of joints, and where all its links are: for one configuration or many. Knows numbers only, no names.
#pragma once

#include <cstddef>
#include <vector>

#include "kernels/kernels.hpp"

namespace coframe {

struct JointDescription {
  JointKind kind = JointKind::still;
  std::ptrdiff_t parent = -1;        // the joint that the link before it hangs from; -1: the root link
  Pose origin;                       // of unit length
  double axis[3] = {0.0, 0.0, 1.0};  // of unit length; of a planar joint the normal of the plane
  std::ptrdiff_t leader = -1;        // the joint it follows, both with one number, as multiplier * position + offset
  double multiplier = 1.0, offset = 0.0;
};

// A joint's position in many configurations. Steps are in bytes: from one configuration to the next, 0 where all have
// the same, and from one number to the next. Without data the joint was not given.
struct JointPositions {
  const char* data = nullptr;
  std::ptrdiff_t step = 0, number_step = 0;
};

// How many numbers the position of a joint has.
std::size_t position_size(JointKind kind);

class JointTree {
 public:
  // Parents stand before their children; std::invalid_argument otherwise, or where joints follow each other in a
  // circle.
  explicit JointTree(const std::vector<JointDescription>& joints);

  std::size_t size() const { return nodes_.size(); }
  JointKind kind(std::size_t joint) const { return nodes_[joint].motion.kind; }

  // Computes the pose of each joint's child link relative to the root link or to its parent link: x, y, z, qx, qy, qz,
  // qw of joint j in configuration i at out + 7 * (j * n + i). Joints that are not given follow the joint they mimic,
  // or are at 0. Returns the first joint with an invalid position (not finite, or a zero quaternion); size() if there
  // is none. `threads` share the work.
  std::size_t poses(const std::vector<JointPositions>& given, std::size_t n, bool in_root, unsigned threads,
                    double* out) const;

 private:
  struct Node {
    JointMotion motion;
    std::ptrdiff_t parent, leader;
    double multiplier, offset;
    bool is_parent;
    std::size_t place;  // where a parent's rows are kept while its children are worked on
  };
  // What a joint's position is made of in the end.
  struct Drive {
    const JointPositions* from;
    double multiplier, offset;
  };

  // All configurations, whose places in `out` and in the positions are known, and of which a part is worked on.
  struct Work {
    const std::vector<JointPositions>& given;
    std::size_t n;
    bool in_root;
    double* out;
  };

  std::size_t poses_of_part(const Work& work, std::size_t first, std::size_t last) const;
  Drive drive(std::size_t joint, const std::vector<JointPositions>& given) const;
  bool read(std::size_t joint, const std::vector<JointPositions>& given, std::size_t first, std::size_t n,
            double (*columns)[kRowBlock]) const;
  void check_leaders() const;
  void order_depth_first();

  std::vector<Node> nodes_;
  std::vector<std::size_t> order_;  // every joint right behind what is above it: few rows are kept at a time
  std::size_t places_ = 0;
};

}  // namespace coframe
