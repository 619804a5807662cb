// SPDX-License-Identifier: Apache-2.0
// Finds the messages in the records of an MCAP file or chunk, see https://mcap.dev/spec.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace coframe {

struct McapRecords {
  // One entry per message: its channel, its log time, the offset of its record, the start and end of its bytes.
  std::vector<std::uint16_t> channels;
  std::vector<std::uint64_t> times;
  std::vector<std::uint64_t> records, starts, ends;

  // A schema or a channel: its opcode, the start and end of its content.
  struct Definition {
    std::uint8_t opcode;
    std::size_t start, end;
  };
  std::vector<Definition> definitions;

  std::size_t size = 0;  // bytes of complete records, up to the first that is truncated or of another kind
};

// Reads messages, schemas and channels from the start until the first record of another kind.
McapRecords find_mcap_records(const std::uint8_t* data, std::size_t size);

}  // namespace coframe
