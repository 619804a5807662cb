// SPDX-License-Identifier: Apache-2.0
// A tree as the parts of a file: a table of its contents, which is read when the file is opened, and the samples, which
// are used in place. coframe/buffer/frozen.py writes the file around them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "core/tree.hpp"

namespace coframe {

// Returns the table: names, authorities, counts, and the number of samples of each frame. The tree must not change
// meanwhile.
std::string frozen_table(const Tree& tree);
// Returns the number of chunks of all dynamic frames. Each frame starts with its own chunk.
std::uint64_t frozen_chunk_count(const Tree& tree);
// Returns the bytes of some of these chunks; fewer at the end.
std::string frozen_chunks(const Tree& tree, std::uint64_t first, std::uint64_t count);

// Fills a new tree. `memory` owns the chunks, which must be aligned to a cache line; see Tree::keep. The tree never
// reads out of bounds, whatever the bytes contain. Returns nullptr, or what is wrong with the bytes; the tree must not
// be used then.
const char* restore(Tree& tree, std::span<const std::uint8_t> table, std::span<const std::uint8_t> chunks,
                    std::shared_ptr<GuardedMemory> memory);

}  // namespace coframe
