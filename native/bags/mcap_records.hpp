// SPDX-License-Identifier: Apache-2.0
// Where the messages lie among the records of an MCAP file or chunk. https://mcap.dev/spec
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace coframe {

struct McapRecords {
  // One entry a message: its channel, its log time, where its record begins, where its bytes begin and end.
  std::vector<std::uint16_t> channels;
  std::vector<std::uint64_t> times;
  std::vector<std::uint64_t> records, starts, ends;

  // A schema or a channel: its opcode, where its content begins and ends.
  struct Definition {
    std::uint8_t opcode;
    std::size_t start, end;
  };
  std::vector<Definition> definitions;

  std::size_t size = 0;  // bytes of whole records, up to the first that is cut off or belongs elsewhere
};

// Reads messages, schemas and channels from the start on, until something else comes.
McapRecords find_mcap_records(const std::uint8_t* data, std::size_t size);

}  // namespace coframe
