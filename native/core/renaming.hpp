// SPDX-License-Identifier: Apache-2.0
// Renames the frames of one robot among several: a prefix is added to all names except shared ones.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace coframe {

// The prefix is added verbatim, like robot_state_publisher's frame_prefix: "robot1/" turns "base_link" into
// "robot1/base_link", and "robot1" turns it into "robot1base_link". A leading slash is removed, as in tf2. Shared
// names, empty names, and names that already begin with a prefix that ends in a slash do not change.
class Renaming {
 public:
  explicit Renaming(std::string prefix = {}, std::vector<std::string> keep = {});

  std::string operator()(std::string_view name) const;
  // Writes the name without the prefix to `out`. Returns false, without writing, for other names.
  bool strip(std::string_view name, std::string& out) const;

  bool keeps(std::string_view name) const;
  bool has_prefix(std::string_view name) const;
  const std::string& prefix() const { return prefix_; }

 private:
  std::string prefix_;
  std::vector<std::string> keep_;
};

// Naming problems of one publisher: an example of each kind, "" if there is none.
struct NameProblems {
  std::string slashed;   // begins with a slash
  std::string prefixed;  // already has the prefix
  std::string plain;     // and one that does not have it

  void note(const Renaming& renaming, std::string_view name);
};

}  // namespace coframe
