// SPDX-License-Identifier: Apache-2.0
#include "core/renaming.hpp"

#include <algorithm>
#include <utility>

#include "core/tree.hpp"

namespace coframe {
namespace {

// Names come from the network, so their length in a message is limited.
constexpr std::size_t kExample = 200;

void keep_first(std::string& example, std::string_view name) {
  if (example.empty()) example = name.substr(0, kExample);
}

}  // namespace

Renaming::Renaming(std::string prefix, std::vector<std::string> keep)
    : prefix_(std::move(prefix)), keep_(std::move(keep)) {}

std::string Renaming::operator()(std::string_view name) const {
  name = without_slash(name);
  if (name.empty() || keeps(name) || (prefix_.ends_with('/') && has_prefix(name))) return std::string(name);
  return prefix_ + std::string(name);
}

bool Renaming::strip(std::string_view name, std::string& out) const {
  name = without_slash(name);
  if (!has_prefix(name)) return false;
  out = name.substr(prefix_.size());
  return true;
}

bool Renaming::keeps(std::string_view name) const { return std::find(keep_.begin(), keep_.end(), name) != keep_.end(); }

bool Renaming::has_prefix(std::string_view name) const {
  return !prefix_.empty() && name.size() > prefix_.size() && name.starts_with(prefix_);
}

void NameProblems::note(const Renaming& renaming, std::string_view name) {
  if (name.starts_with('/')) keep_first(slashed, name);
  name = without_slash(name);
  if (renaming.prefix().empty() || name.empty() || renaming.keeps(name)) return;
  keep_first(renaming.has_prefix(name) ? prefixed : plain, name);
}

}  // namespace coframe
