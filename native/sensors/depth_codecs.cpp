// SPDX-License-Identifier: Apache-2.0
#include "sensors/depth_codecs.hpp"

#include <algorithm>
#include <cstdlib>

namespace coframe {

namespace {

// PNG's predictor: the neighbor that is nearest to left + above - corner.
std::uint8_t paeth(int left, int above, int upper_left) {
  const int from_left = std::abs(above - upper_left), from_above = std::abs(left - upper_left);
  const int from_upper_left = std::abs(left + above - 2 * upper_left);
  if (from_left <= from_above && from_left <= from_upper_left) return static_cast<std::uint8_t>(left);
  return static_cast<std::uint8_t>(from_above <= from_upper_left ? above : upper_left);
}

// Numbers in groups of four bits: three bits of the number, lowest first, and whether another group follows.
class RvlNumbers {
 public:
  RvlNumbers(const std::uint32_t* words, std::size_t count) : words_(words), groups_(count * 8) {}

  bool next(std::uint32_t& value) {
    value = 0;
    for (unsigned shift = 0; at_ < groups_; shift += 3) {
      const std::uint32_t group = (words_[at_ / 8] >> (28 - 4 * (at_ % 8))) & 15;
      ++at_;
      if (shift < 32) value |= (group & 7) << shift;
      if (group < 8) return true;
    }
    return false;
  }

 private:
  const std::uint32_t* words_;
  std::size_t groups_, at_ = 0;
};

}  // namespace

bool unfilter_png(const std::uint8_t* rows, std::uint8_t* pixels, std::size_t height, std::size_t row_bytes,
                  std::size_t pixel_bytes) {
  for (std::size_t y = 0; y < height; ++y) {
    const std::uint8_t filter = *rows++;
    std::uint8_t* row = pixels + y * row_bytes;
    const std::uint8_t* previous_row = y > 0 ? row - row_bytes : nullptr;
    if (filter > 4) return false;
    for (std::size_t x = 0; x < row_bytes; ++x) {
      const int left_pixel = x >= pixel_bytes ? row[x - pixel_bytes] : 0;
      const int upper_pixel = previous_row ? previous_row[x] : 0;
      const int upper_left_pixel = previous_row && x >= pixel_bytes ? previous_row[x - pixel_bytes] : 0;
      const int predicted = filter == 0   ? 0
                            : filter == 1 ? left_pixel
                            : filter == 2 ? upper_pixel
                            : filter == 3 ? (left_pixel + upper_pixel) / 2
                                          : paeth(left_pixel, upper_pixel, upper_left_pixel);
      row[x] = static_cast<std::uint8_t>(*rows++ + predicted);
    }
  }
  return true;
}

bool decode_rvl(const std::uint32_t* words, std::size_t word_count, std::uint16_t* depths, std::size_t count) {
  RvlNumbers numbers(words, word_count);
  std::uint16_t depth = 0;
  std::size_t at = 0;
  while (at < count) {
    std::uint32_t zeros = 0, measured = 0;
    if (!numbers.next(zeros) || zeros > count - at) return false;
    std::fill_n(depths + at, zeros, std::uint16_t{0});
    at += zeros;
    if (at == count) return true;
    if (!numbers.next(measured) || measured > count - at) return false;
    if (zeros == 0 && measured == 0) return false;
    for (const std::size_t end = at + measured; at < end; ++at) {
      std::uint32_t change = 0;
      if (!numbers.next(change)) return false;
      depth = static_cast<std::uint16_t>(depth + ((change >> 1) ^ (0U - (change & 1))));
      depths[at] = depth;
    }
  }
  return true;
}

}  // namespace coframe
