// SPDX-License-Identifier: Apache-2.0
// PNG's row filters: what is stored is the difference from a prediction.
#pragma once

#include <cstddef>

namespace fastrt {

// Writes one row of `count` bytes (RGB, three a pixel) as its filter's number and the filtered bytes, count +
// 1 in all. `row` and `above` need three zero bytes before them; for the first row `above` is all zeros.
// scratch: count bytes. Picks the filter whose differences are smallest in sum.
void filter_row(const unsigned char* row, const unsigned char* above, std::size_t count,
                unsigned char* scratch, unsigned char* out) noexcept;

} // namespace fastrt
