// SPDX-License-Identifier: Apache-2.0
#include "src/cli/parse.hpp"

#include <fastrt/error.hpp>

#include <gtest/gtest.h>

#include <string>

namespace fastrt::cli {
namespace {

TEST(CliParse, IntegersInsideTheRange) {
  EXPECT_EQ(parse_integer("--spp", "1", 1, 8), 1);
  EXPECT_EQ(parse_integer("--spp", "8", 1, 8), 8);
  EXPECT_EQ(parse_integer("--n", "-3", -3, 8), -3);
}

TEST(CliParse, IntegersThatAreNone) {
  for (const char* text : {"0", "9", "-1", "abc", "", " 1", "1 ", "1.5", "1e0", "0x1", "+1", "1,",
                           "1000000000", "99999999999999999999"}) {
    EXPECT_THROW(parse_integer("--spp", text, 1, 8), UsageError) << text;
  }
}

TEST(CliParse, MessagesNameTheOptionAndTheText) {
  try {
    parse_integer("--spp", "x", 1, 8);
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_EQ(std::string(error.what()), "--spp: 'x' is not a whole number from 1 to 8");
  }
}

TEST(CliParse, Numbers) {
  EXPECT_EQ(parse_number("--fov", "40"), 40.0F);
  EXPECT_EQ(parse_number("--fov", "+.5"), 0.5F);
  EXPECT_EQ(parse_number("--fov", "-1e-3"), -1e-3F);
  for (const char* text :
       {"", "+", "-", "nan", "inf", "-inf", "1e999", "1,5", "1x", "0x1p3", "+-1", "++1", " 1"}) {
    EXPECT_THROW(parse_number("--fov", text), UsageError) << text;
  }
}

TEST(CliParse, Vectors) {
  EXPECT_EQ(parse_vector("--eye", "1,-2,3.5"), Vec3(1, -2, 3.5F));
  for (const char* text : {"", "1", "1,2", "1,2,", "1,2,3,", "1,2,3,4", ",,", "1;2;3", "1,2,nan", "1, 2,3"}) {
    EXPECT_THROW(parse_vector("--eye", text), UsageError) << text;
  }
}

TEST(CliParse, ColorsAreNotNegative) {
  EXPECT_EQ(parse_color("--ambient", "0,0.5,2"), Vec3(0, 0.5F, 2));
  EXPECT_THROW(parse_color("--ambient", "0,-0.5,2"), UsageError);
}

TEST(CliParse, Resolutions) {
  for (const char* text : {"640x480", "640X480", "640,480"}) {
    const Resolution size = parse_resolution("-r", text);
    EXPECT_EQ(size.width, 640) << text;
    EXPECT_EQ(size.height, 480) << text;
  }
  EXPECT_EQ(parse_resolution("-r", "65536x65536").height, 65536);
  for (const char* text : {"", "640", "x", "640x", "x480", "0x480", "640x0", "-5x5", "65537x1", "1x65537",
                           "99999999x1", "640x480x3", "640 x 480", "6.4x4"}) {
    EXPECT_THROW(parse_resolution("-r", text), UsageError) << text;
  }
}

} // namespace
} // namespace fastrt::cli
