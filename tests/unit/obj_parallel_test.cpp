// SPDX-License-Identifier: Apache-2.0
// However a file is cut up and however many threads read it: the same scene, the same messages.
#include "tests/unit/obj_test_support.hpp"

#include <random>

namespace fastrt {
namespace {

using namespace test;

// A file with everything in it, in random order.
std::string make_file(unsigned seed, int statements, const char* line_end, bool has_colors = false) {
  std::mt19937 random(seed);
  const auto below = [&random](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  std::string text;
  int v = 0, t = 0, n = 0;
  const auto number = [&] {
    return std::to_string(below(2000) - 1000) + '.' + std::to_string(below(100000));
  };
  const auto index = [&](int count) {
    return std::to_string(below(2) == 0 ? 1 + below(count) : -1 - below(count));
  };
  for (int i = 0; i < statements; ++i) {
    const int kind = v < 4 ? 0 : t < 2 ? 1 : n < 2 ? 2 : below(13);
    switch (kind) {
    case 0:
    case 3:
    case 4:
      text += "v " + number() + ' ' + number() +
              (below(9) == 0 ? std::string(" \\") + line_end + "  " : " ") + number();
      if (has_colors && i > statements / 2 && below(2) == 0)
        for (int k = 0; k < 3; ++k) text += below(99) == 0 ? " 1.5" : " 0." + std::to_string(below(1000));
      ++v;
      break;
    case 1:
      text += "vt " + number() + ' ' + number();
      ++t;
      break;
    case 2:
      text += "vn " + number() + ' ' + number() + " 1";
      ++n;
      break;
    case 5:
    case 6:
    case 7:
    case 8: {
      text += below(9) == 0 ? "  f" : "f";
      const int corners = below(4) == 0 ? 2 + below(7) : 3, form = below(4);
      for (int k = 0; k < corners; ++k) {
        text += ' ' + index(v);
        if (form == 1) text += '/' + index(t);
        if (form == 2) text += "//" + index(n);
        if (form == 3) text += '/' + index(t) + '/' + index(n);
      }
      break;
    }
    case 9:
      text += "usemtl m" + std::to_string(below(3));
      break;
    case 10:
      text += "o object " + std::to_string(below(5));
      break;
    case 11:
      text += "s " + std::to_string(below(3));
      break;
    default:
      text += below(2) == 0 ? "# comment \\" : "";
    }
    text += line_end;
  }
  return text;
}

ObjReaderSettings settings_with(std::size_t chunk_bytes, int threads) {
  ObjReaderSettings settings = settings_for_tests();
  settings.chunk_bytes = chunk_bytes;
  settings.threads = threads;
  settings.read_library = {};
  return settings;
}

TEST(ObjParallel, ChunksAndThreadsDoNotMatter) {
  for (const char* line_end : {"\n", "\r\n", "\r"}) {
    for (unsigned seed = 0; seed < 3; ++seed) {
      const bool has_colors = seed == 2;
      const std::string text = make_file(seed, 500, line_end, has_colors);
      const Loaded whole = parse(text, settings_with(1U << 20U, 1));
      EXPECT_EQ(whole.desc.colors.size(), has_colors ? whole.desc.positions.size() : 0U);
      EXPECT_GT(whole.desc.triangles.size(), 100U);
      EXPECT_TRUE(is_sound(whole.desc));
      for (const std::size_t chunk_bytes : {4UL, 31UL, 200UL, 5000UL})
        for (const int threads : {1, 3}) {
          const Loaded cut = parse(text, settings_with(chunk_bytes, threads));
          EXPECT_TRUE(same_columns(whole.desc, cut.desc)) << seed << ' ' << chunk_bytes << ' ' << threads;
          EXPECT_EQ(whole.warnings(), cut.warnings()) << seed << ' ' << chunk_bytes << ' ' << threads;
          EXPECT_EQ(whole.diagnostics.count(), cut.diagnostics.count());
        }
    }
  }
}

TEST(ObjParallel, MaterialsCarryOverIntoLaterChunks) {
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nmtllib x\nusemtl b\n";
  for (int i = 0; i < 200; ++i) text += "f 1 2 3\n";
  text += "usemtl a\nf 1 2 3\nusemtl\nf 1 2 3\n";
  for (const int threads : {1, 4}) {
    ObjReaderSettings settings = settings_with(50, threads);
    settings.read_library = [](const std::string& names, std::uint64_t offset, MaterialSet& materials,
                               EventLog&) {
      EXPECT_EQ(names, "x");
      EXPECT_EQ(offset, 24U);
      for (const char* name : {"a", "b"}) {
        Material material;
        material.name = name;
        materials.add(material);
      }
    };
    const Loaded loaded = parse(text, settings);
    const auto& material = loaded.desc.triangles.material;
    ASSERT_EQ(material.size(), 202U);
    for (std::size_t i = 0; i < 200; ++i) ASSERT_EQ(material[i], 1U);
    EXPECT_EQ(material[200], 0U);
    EXPECT_EQ(material[201], 2U);
    EXPECT_EQ(loaded.desc.materials.size(), 3U);
  }
}

TEST(ObjParallel, TheFirstErrorIsReported) {
  const std::string good = make_file(9, 300, "\n");
  std::vector<std::size_t> starts;
  for (std::size_t i = 0; i < good.size(); ++i)
    if (good[i] == '\n' && (i == 0 || good[i - 1] != '\\')) starts.push_back(i + 1);
  std::mt19937 random(10);
  for (int round = 0; round < 20; ++round) {
    std::string text = good;
    for (int k = 0; k < 3; ++k) {
      const std::size_t at = starts[random() % starts.size()];
      if (at >= text.size()) continue;
      const std::string bad = k == 0 ? "v 1 oops 2\n" : k == 1 ? "f 1 2 999999\n" : "vt nan\n";
      text.insert(at, bad);
    }
    const std::string expected = error_of(text, settings_with(1U << 20U, 1));
    EXPECT_NE(expected, "");
    for (const std::size_t chunk_bytes : {64UL, 500UL})
      for (const int threads : {1, 2, 8})
        EXPECT_EQ(error_of(text, settings_with(chunk_bytes, threads)), expected);
  }
}

TEST(ObjParallel, TheFirstErrorComesFirstOfAll) {
  std::string text = "v 0 0 0\n";
  for (int i = 0; i < 1000; ++i) text += "v 1 2 " + std::to_string(i) + "\n";
  text += "v 1 2\n"; // line 1002
  for (int i = 0; i < 1000; ++i) text += i % 7 == 0 ? "f 9999999 2 3\n" : "v 1 2 3\n";
  for (const int threads : {1, 2, 8})
    EXPECT_TRUE(contains(error_of(text, settings_with(128, threads)), "t.obj:1002:1: 'v' needs 3"));
}

// Cut off anywhere, the file either loads or is refused, and what loads is sound.
TEST(ObjParallel, TruncationAnywhereDoesNoHarm) {
  std::string text = make_file(11, 150, "\n");
  text.resize(std::min<std::size_t>(text.size(), 2048));
  int loaded_count = 0;
  for (std::size_t size = 0; size <= text.size(); ++size) {
    for (const std::size_t chunk_bytes : {32UL, 4096UL}) {
      try {
        const Loaded loaded = parse(std::string_view(text).substr(0, size), settings_with(chunk_bytes, 2));
        EXPECT_TRUE(is_sound(loaded.desc)) << size;
        ++loaded_count;
      } catch (const InputError& error) {
        EXPECT_TRUE(contains(error.what(), "t.obj:")) << size;
      }
    }
  }
  EXPECT_GT(loaded_count, 1000);
}

// Any byte replaced by another: never a crash, never an index out of range.
TEST(ObjParallel, DamageDoesNoHarm) {
  const std::string text = make_file(12, 200, "\n");
  std::mt19937 random(13);
  for (int round = 0; round < 1000; ++round) {
    std::string damaged = text;
    for (unsigned k = 0; k <= random() % 4; ++k)
      damaged[random() % damaged.size()] = static_cast<char>(random());
    try {
      EXPECT_TRUE(is_sound(parse(damaged, settings_with(200, 1 + round % 2)).desc));
    } catch (const InputError&) {
      continue;
    }
  }
}

} // namespace
} // namespace fastrt
