// SPDX-License-Identifier: Apache-2.0
// A tree as the parts of a file: a table of what is in it, read when it is opened, and the samples, which are used
// where they lie. The file around them is coframe/frozen.py's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "core/tree.hpp"

namespace coframe {

// Of a tree that does not change meanwhile: names, authorities, counts, and how many samples each frame has.
std::string frozen_table(const Tree& tree);
// How many chunks all its moving frames have, one frame after the other, each from a chunk of its own on.
std::uint64_t frozen_chunk_count(const Tree& tree);
// Some of them as they go to the file; what is beyond the last is left out.
std::string frozen_chunks(const Tree& tree, std::uint64_t first, std::uint64_t count);

// Fills a new tree; `memory` holds the chunks and must be aligned to a cache line. Whatever the bytes are, the tree
// never reads beyond them. Returns what is wrong with them, or nullptr; then the tree is not to be used.
const char* restore(Tree& tree, std::span<const std::uint8_t> table, std::span<const std::uint8_t> chunks,
                    std::shared_ptr<const void> memory);

}  // namespace coframe
