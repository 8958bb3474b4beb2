// SPDX-License-Identifier: Apache-2.0
// Pairs of a ray and a primitive as the pair kernels take them, and numbers that arithmetic stumbles over.
#pragma once

#include "src/kernels/kernel_table.hpp"
#include "src/reference/intersect.hpp"
#include "tests/unit/reference_shapes.hpp"

#include <array>
#include <limits>
#include <vector>

namespace fastrt::test {

// One pair: nine numbers of a primitive (fewer for spheres and boxes) and a ray.
struct Pair {
  std::array<float, 9> primitive{};
  reference::Ray ray;
};

inline void put(Pair& pair, int at, const Vec3& v) {
  for (int axis = 0; axis < 3; ++axis) pair.primitive[static_cast<std::size_t>(at + axis)] = v[axis];
}
inline Vec3 get(const Pair& pair, int at) {
  const auto i = static_cast<std::size_t>(at);
  return {pair.primitive[i], pair.primitive[i + 1], pair.primitive[i + 2]};
}

class PairTable {
public:
  explicit PairTable(std::size_t count) : pairs_(count) {
    for (std::vector<float>& column : columns_) column.resize(count);
  }
  std::vector<Pair>& pairs() { return pairs_; }
  const Pair& operator[](std::size_t i) const { return pairs_[i]; }
  std::size_t size() const { return pairs_.size(); }

  // As columns; valid until the next call.
  PairColumns columns() {
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      for (std::size_t c = 0; c < 9; ++c) columns_[c][i] = pairs_[i].primitive[c];
      for (int axis = 0; axis < 3; ++axis) {
        columns_[static_cast<std::size_t>(9 + axis)][i] = pairs_[i].ray.origin[axis];
        columns_[static_cast<std::size_t>(12 + axis)][i] = pairs_[i].ray.direction[axis];
      }
      columns_[15][i] = pairs_[i].ray.t_min;
    }
    PairColumns out{};
    for (std::size_t c = 0; c < 9; ++c) out.primitive[c] = columns_[c].data();
    for (std::size_t c = 0; c < 3; ++c) {
      out.origin[c] = columns_[9 + c].data();
      out.dir[c] = columns_[12 + c].data();
    }
    out.t_min = columns_[15].data();
    out.count = pairs_.size();
    return out;
  }

private:
  std::vector<Pair> pairs_;
  std::array<std::vector<float>, 16> columns_;
};

// Zeros, denormals, the largest, infinities, NaN, and ordinary numbers among them.
inline float odd_number(Random& random) {
  using Limits = std::numeric_limits<float>;
  constexpr std::array<float, 14> odd{0.0F,
                                      -0.0F,
                                      1.0F,
                                      -1.0F,
                                      0x1p-149F,
                                      -0x1p-140F,
                                      Limits::min(),
                                      Limits::max(),
                                      -Limits::max(),
                                      1e30F,
                                      -1e30F,
                                      Limits::infinity(),
                                      -Limits::infinity(),
                                      Limits::quiet_NaN()};
  const std::uint32_t choice = random.below(28);
  return choice < odd.size() ? odd[choice] : random.uniform(-2, 2);
}
inline Vec3 odd_vector(Random& random) {
  const float x = odd_number(random);
  const float y = odd_number(random);
  return {x, y, odd_number(random)};
}

// Sizes from e^-low to e^high, evenly over their logarithms.
inline float any_size(Random& random, float low, float high) { return std::exp(random.uniform(low, high)); }

// Along an axis, either way, with zeros of either sign.
inline Vec3 axis_direction(Random& random) {
  Vec3 direction;
  for (int i = 0; i < 3; ++i) direction[i] = random.below(2) == 0 ? 0.0F : -0.0F;
  direction[static_cast<int>(random.below(3))] = random.below(2) == 0 ? 1.0F : -1.0F;
  return direction;
}

} // namespace fastrt::test
