// SPDX-License-Identifier: Apache-2.0
// The records of an MCAP chunk are found, and every slice lies within the chunk.

#include "bags/mcap_records.hpp"
#include "input.hpp"

using namespace coframe;
using namespace coframe::fuzz;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Exact bytes({data, size});
  const McapRecords found = find_mcap_records(bytes.data(), bytes.size());
  expect(found.size <= size, "records beyond the end");
  const std::size_t count = found.channels.size();
  expect(found.times.size() == count && found.records.size() == count && found.starts.size() == count &&
             found.ends.size() == count,
         "columns of different lengths");
  for (std::size_t i = 0; i < count; ++i) {
    expect(found.records[i] < found.starts[i] && found.starts[i] <= found.ends[i] && found.ends[i] <= found.size,
           "a message beyond the end");
  }
  for (const auto& [opcode, start, end] : found.definitions) {
    expect(start <= end && end <= found.size, "a definition beyond the end");
  }
  return 0;
}
