// SPDX-License-Identifier: Apache-2.0
// pow and exp of every ISA against the same text run on one float: equal bits for any bits going in.
#include "src/simd/shared_math.hpp"
#include "tests/equivalence/isas.hpp"
#include "tests/equivalence/pairs.hpp"

#include <gtest/gtest.h>

namespace fastrt::test {
namespace {

using baseline::ScalarOps;

constexpr std::size_t table_size = 65536;

class MathKernel : public testing::TestWithParam<Isa> {
protected:
  void expect_same_powers() {
    kernels_of(GetParam()).powers(x_.data(), y_.data(), out_.data(), table_size);
    for (std::size_t i = 0; i < table_size; ++i)
      if (!same(out_[i], baseline::shared_pow<ScalarOps>(x_[i], y_[i])))
        FAIL() << "pow(" << x_[i] << ", " << y_[i] << ") is " << out_[i];
  }
  void expect_same_exponentials() {
    kernels_of(GetParam()).exponentials(x_.data(), out_.data(), table_size);
    for (std::size_t i = 0; i < table_size; ++i)
      if (!same(out_[i], baseline::shared_exp<ScalarOps>(x_[i])))
        FAIL() << "exp(" << x_[i] << ") is " << out_[i];
  }
  std::vector<float> x_ = std::vector<float>(table_size);
  std::vector<float> y_ = std::vector<float>(table_size);
  std::vector<float> out_ = std::vector<float>(table_size);
};

float any_bits(Random& random) { return std::bit_cast<float>(random.word()); }

TEST_P(MathKernel, PowersAreTheTwins) {
  Random random(41);
  for (int pass = 0; pass < effort(40); ++pass) {
    for (std::size_t i = 0; i < table_size; ++i) {
      x_[i] = pass % 2 == 0 ? random.uniform() : any_size(random, -87, 88);
      y_[i] = pass % 3 == 0 ? random.uniform(1, 2000) : any_size(random, 0, 12);
    }
    expect_same_powers();
  }
}

TEST_P(MathKernel, PowersOfAnyBitsAreTheTwins) {
  Random random(42);
  for (int pass = 0; pass < effort(40); ++pass) {
    for (std::size_t i = 0; i < table_size; ++i) {
      // Callers leave x <= 0 out.
      x_[i] = std::fabs(pass % 2 == 0 ? any_bits(random) : odd_number(random));
      y_[i] = pass % 4 < 2 ? any_bits(random) : odd_number(random);
    }
    expect_same_powers();
  }
}

TEST_P(MathKernel, ExponentialsAreTheTwins) {
  Random random(43);
  for (int pass = 0; pass < effort(40); ++pass) {
    for (float& x : x_) x = pass % 2 == 0 ? random.uniform(-100, 100) : -any_size(random, -60, 60);
    expect_same_exponentials();
  }
}

TEST_P(MathKernel, ExponentialsOfAnyBitsAreTheTwins) {
  Random random(44);
  for (int pass = 0; pass < effort(40); ++pass) {
    for (float& x : x_) x = pass % 2 == 0 ? any_bits(random) : odd_number(random);
    expect_same_exponentials();
  }
}

INSTANTIATE_TEST_SUITE_P(Isas, MathKernel, testing::ValuesIn(simd_isas()), IsaWord());

} // namespace
} // namespace fastrt::test
