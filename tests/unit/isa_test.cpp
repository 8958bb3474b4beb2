// SPDX-License-Identifier: Apache-2.0
#include <fastrt/error.hpp>
#include <fastrt/isa.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace fastrt {
namespace {

constexpr Isa all[] = {Isa::scalar, Isa::sse42, Isa::avx2, Isa::avx512};

TEST(IsaNames, AreTheCommandLines) {
  EXPECT_STREQ(isa_name(Isa::scalar), "scalar");
  EXPECT_STREQ(isa_name(Isa::sse42), "sse4.2");
  EXPECT_STREQ(isa_name(Isa::avx2), "avx2");
  EXPECT_STREQ(isa_name(Isa::avx512), "avx512");
}

TEST(IsaWidths, AreFloatsPerRegister) {
  EXPECT_EQ(isa_width(Isa::scalar), 1);
  EXPECT_EQ(isa_width(Isa::sse42), 4);
  EXPECT_EQ(isa_width(Isa::avx2), 8);
  EXPECT_EQ(isa_width(Isa::avx512), 16);
}

TEST(AvailableIsas, AreTheAvailableOnesTheWidestFirst) {
  const std::vector<Isa> available = available_isas();
  for (const Isa isa : all)
    EXPECT_EQ(isa_available(isa), std::count(available.begin(), available.end(), isa) == 1) << isa_name(isa);
  EXPECT_TRUE(std::is_sorted(available.begin(), available.end(),
                             [](Isa a, Isa b) { return isa_width(a) > isa_width(b); }));
  EXPECT_EQ(available.back(), Isa::scalar);
}

TEST(AvailableIsas, AWiderOneBringsTheNarrower) {
  if (isa_available(Isa::avx512)) {
    EXPECT_TRUE(isa_available(Isa::avx2));
  }
  if (isa_available(Isa::avx2)) {
    EXPECT_TRUE(isa_available(Isa::sse42));
  }
}

TEST(SelectIsa, TakesTheWidestByItself) {
  EXPECT_EQ(select_isa("auto"), available_isas().front());
  EXPECT_EQ(select_isa(""), available_isas().front());
}

TEST(SelectIsa, TakesWhatIsAskedForOrSaysWhatThereIs) {
  for (const Isa isa : all) {
    if (isa_available(isa)) {
      EXPECT_EQ(select_isa(isa_name(isa)), isa);
      continue;
    }
    try {
      select_isa(isa_name(isa));
      ADD_FAILURE() << isa_name(isa) << " is not available but was selected";
    } catch (const UsageError& error) {
      EXPECT_NE(std::string(error.what()).find(isa_name(isa)), std::string::npos);
      EXPECT_NE(std::string(error.what()).find("available: "), std::string::npos);
    }
  }
}

TEST(SelectIsa, RefusesUnknownNames) {
  for (const char* name : {"AVX2", "sse42", "neon", "auto ", "avx"}) {
    try {
      select_isa(name);
      ADD_FAILURE() << name;
    } catch (const UsageError& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find("unknown ISA '" + std::string(name) + "'"), std::string::npos) << message;
      for (const Isa isa : available_isas())
        EXPECT_NE(message.find(isa_name(isa)), std::string::npos) << message;
    }
  }
}

} // namespace
} // namespace fastrt
