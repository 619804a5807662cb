// SPDX-License-Identifier: Apache-2.0
// Splits work between threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <system_error>
#include <thread>
#include <vector>

namespace coframe {

// Calls body(first, last) for parts of [0, count), each in its own thread. Parts begin at multiples of `block`, so
// there may be fewer parts than threads.
template <class Body>
void in_parts(std::size_t count, std::size_t block, unsigned threads, Body&& body) {
  const std::size_t blocks = (count + block - 1) / block;
  const std::size_t parts = std::clamp<std::size_t>(threads, 1, std::max<std::size_t>(blocks, 1));
  const auto border = [&](std::size_t part) { return std::min(count, blocks * part / parts * block); };
  std::vector<std::thread> others;
  for (std::size_t part = 1; part < parts; ++part) {
    try {
      others.emplace_back([&, part] { body(border(part), border(part + 1)); });
    } catch (const std::system_error&) {  // the system has no more threads
      body(border(part), border(part + 1));
    }
  }
  body(border(0), border(1));
  for (std::thread& other : others) other.join();
}

}  // namespace coframe
