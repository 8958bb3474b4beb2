// SPDX-License-Identifier: Apache-2.0
// Boxes to build trees over, easy ones and hard ones.
#pragma once

#include "src/accel/tree.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <ostream>
#include <string>

namespace fastrt {

// A small generator of their own, so that every platform tests the same boxes.
class Random {
public:
  float operator()(float first, float last) {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return first + (last - first) * (static_cast<float>(state_ >> 40U) * 0x1p-24F);
  }

private:
  std::uint64_t state_ = 1;
};

inline PrimitiveBox box_around(float x, float y, float z, float half, std::size_t id,
                               std::uint32_t group = 0) {
  return {
      {x - half, y - half, z - half}, static_cast<std::uint32_t>(id), {x + half, y + half, z + half}, group};
}

using Generator = std::function<PrimitiveBox(std::size_t, Random&)>;

struct Case {
  const char* name;
  std::size_t count;
  Generator generate;

  Column<PrimitiveBox> boxes() const {
    Column<PrimitiveBox> result;
    Random random;
    for (std::size_t i = 0; i < count; ++i) result.push_back(generate(i, random));
    return result;
  }
};

inline void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

inline PrimitiveBox random_box(std::size_t i, Random& r) {
  return box_around(r(-1, 1), r(-1, 1), r(-1, 1), r(0, 0.02F), i);
}

inline PrimitiveBox sheet(std::size_t i, Random& r) {
  PrimitiveBox box = box_around(r(-1, 1), 0, r(-1, 1), 0.01F, i);
  box.lower[1] = box.upper[1] = 3;
  return box;
}

inline PrimitiveBox huge_or_small(std::size_t i, Random& r) {
  return box_around(r(-1, 1), r(-1, 1), r(-1, 1), i % 50 == 0 ? 1e6F : 1e-4F, i);
}

inline PrimitiveBox exponential(std::size_t i, Random& /*unused*/) {
  const float x = std::ldexp(1.0F, static_cast<int>(i % 250) - 125);
  return box_around(x, x, 0, 0, i);
}

inline PrimitiveBox two_groups(std::size_t i, Random& r) {
  PrimitiveBox box = random_box(i, r);
  box.group = i % 3 == 0 ? 7 : 2;
  return box;
}

// Boxes of all groups in one spot: only the group tells them apart.
inline PrimitiveBox all_groups_at_once(std::size_t i, Random& /*unused*/) {
  return box_around(1, 2, 3, 1, i, static_cast<std::uint32_t>(i % max_groups));
}

inline PrimitiveBox extreme(std::size_t i, Random& r) {
  const float size = i % 2 == 0 ? 3e38F : 1e-38F;
  return box_around(r(-1, 1) * size, r(-1, 1) * size, r(-1, 1) * size, 0, i);
}

// After the first split, what is known of the centroids is far from what they are.
inline PrimitiveBox two_dense_clusters(std::size_t i, Random& r) {
  return box_around((i % 2 == 0 ? 0.0F : 100.0F) + r(0, 1e-3F), r(0, 1e-3F), r(0, 1e-3F), 50, i);
}

inline const Case cases[] = {
    {"random", 5000, random_box},
    {"many", 150000, random_box},
    {"sheet", 40000, sheet},
    {"identical", 3001, [](std::size_t i, Random&) { return box_around(1, 2, 3, 0.5F, i); }},
    {"identical_many", 100000, [](std::size_t i, Random&) { return box_around(1, 2, 3, 0.5F, i); }},
    {"huge_or_small", 20000, huge_or_small},
    {"points_on_a_line", 10000,
     [](std::size_t i, Random&) { return box_around(static_cast<float>(i), 0, 0, 0, i); }},
    {"diagonal", 40000,
     [](std::size_t i, Random&) {
       const auto x = static_cast<float>(i);
       return box_around(x, -x, 2 * x, 0.7F, i);
     }},
    {"exponential", 250, exponential},
    {"exponential_many", 120000, exponential},
    {"two_dense_clusters", 60000, two_dense_clusters},
    {"two_groups", 30000, two_groups},
    {"all_groups_at_once", 1000, all_groups_at_once},
    {"extreme", 2000, extreme},
    {"extreme_many", 60000, extreme},
};

// The bytes of a column, to compare.
template <class T>
std::string bytes(const Column<T>& column) {
  return std::string(reinterpret_cast<const char*>(column.data()), column.size() * sizeof(T));
}

} // namespace fastrt
