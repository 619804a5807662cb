// SPDX-License-Identifier: Apache-2.0
// The frames of one robot among those of others: a prefix in front of all names but those that are shared.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace coframe {

// The prefix is put there as it is, as robot_state_publisher's frame_prefix: "robot1/" makes "robot1/base_link" of
// "base_link", and "robot1" makes "robot1base_link". A leading slash of a name goes, as in tf2. Names that are shared,
// that are empty, or that already begin with a prefix that ends with a slash stay as they are.
class Renaming {
 public:
  explicit Renaming(std::string prefix = {}, std::vector<std::string> keep = {});

  std::string operator()(std::string_view name) const;
  // The name without the prefix; false, and nothing is done, for others.
  bool strip(std::string_view name, std::string& out) const;

  bool keeps(std::string_view name) const;
  bool has_prefix(std::string_view name) const;
  const std::string& prefix() const { return prefix_; }

 private:
  std::string prefix_;
  std::vector<std::string> keep_;
};

// What is odd about the names of one source: an example of each, "" where there is none.
struct NameProblems {
  std::string slashed;   // begins with a slash
  std::string prefixed;  // already has the prefix,
  std::string plain;     // and this one has not

  void note(const Renaming& renaming, std::string_view name);
};

}  // namespace coframe
