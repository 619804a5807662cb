// SPDX-License-Identifier: Apache-2.0
// The two formats of compressed depth images whose decoding is a loop over every byte: PNG's filters, and RVL.
#pragma once

#include <cstddef>
#include <cstdint>

namespace coframe {

// Undoes the filters of PNG rows, which begin with the number of their filter. Returns false for an unknown filter.
bool unfilter_png(const std::uint8_t* rows, std::uint8_t* pixels, std::size_t height, std::size_t row_bytes,
                  std::size_t pixel_bytes);

// Decodes runs of zeros and of differences. Returns false if the data ends early or exceeds the image.
bool decode_rvl(const std::uint32_t* words, std::size_t word_count, std::uint16_t* depths, std::size_t count);

}  // namespace coframe
