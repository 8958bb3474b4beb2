// SPDX-License-Identifier: Apache-2.0
// Files as they lie on a disk: which are read, which are refused.
#include "src/load/material_files.hpp"
#include "tests/unit/obj_test_support.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <thread>

namespace fastrt {
namespace {

using namespace test;

constexpr const char* triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

TEST(ObjFiles, AreReadByExtension) {
  const TemporaryFolder folder;
  Diagnostics diagnostics;
  EXPECT_EQ(load_scene(folder.write("a.obj", triangle), {}, diagnostics).triangles.size(), 1U);
  EXPECT_EQ(load_scene(folder.write("b.OBJ", triangle), {}, diagnostics).object_names[0], "b");
  EXPECT_THROW(load_scene(folder.write("a.xyz", triangle), {}, diagnostics), UsageError);
  EXPECT_THROW(load_scene(folder.path() / "none", {}, diagnostics), UsageError);
}

TEST(ObjFiles, WhatIsNoRegularFileIsRefused) {
  const TemporaryFolder folder;
  EXPECT_TRUE(contains(load_error(folder.path() / "none.obj"), "No such file or directory"));
  EXPECT_TRUE(contains(load_error(folder.path()), "it is a directory"));
  EXPECT_TRUE(contains(load_error("/dev/zero"), "not a regular file"));
  const auto fifo = folder.path() / "fifo.obj";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  EXPECT_TRUE(contains(load_error(fifo), "not a regular file"));
  const auto secret = folder.write("secret.obj", triangle);
  ASSERT_EQ(::chmod(secret.c_str(), 0), 0);
  if (::geteuid() != 0) {
    EXPECT_TRUE(contains(load_error(secret), "Permission denied"));
  }
}

TEST(ObjFiles, MaterialFilesAreFound) {
  const TemporaryFolder folder;
  folder.write("one.mtl", "newmtl one\nKd 1 0 0\n");
  folder.write("two words.mtl", "newmtl two\nKd 0 1 0\n");
  folder.write("sub/three.mtl", "newmtl three\nKd 0 0 1\n");
  const std::string uses =
      std::string(triangle) + "usemtl one\nf 1 2 3\nusemtl two\nf 1 2 3\nusemtl three\nf 1 2 3\n";
  for (const std::string libraries :
       {"mtllib one.mtl\nmtllib two words.mtl\nmtllib sub/three.mtl\n",
        "mtllib  one.mtl sub/three.mtl \nmtllib \"two words.mtl\"\n",
        "mtllib one.mtl\nmtllib one.mtl\nmtllib ./two words.mtl\nmtllib .\\sub\\three.mtl\n",
        "mtllib sub/../one.mtl\nmtllib two words.mtl\nmtllib sub/three.mtl # here\n"}) {
    const Loaded loaded = load(folder.write("scene.obj", libraries + uses));
    EXPECT_EQ(loaded.warnings(), std::vector<std::string>{}) << libraries;
    ASSERT_EQ(loaded.desc.materials.size(), 4U) << libraries; // and the default one
    for (std::size_t i = 1; i < 4; ++i)
      EXPECT_GT(loaded.desc.materials[loaded.desc.triangles.material[i]].diffuse[static_cast<int>(i) - 1],
                0.9F);
    EXPECT_EQ(loaded.desc.triangles.material[0], 3U);
  }
}

TEST(ObjFiles, MaterialFilesMayComeLateAndTheDefaultIsLeftOutIfUnused) {
  const TemporaryFolder folder;
  folder.write("one.mtl", "newmtl one\n");
  const Loaded loaded =
      load(folder.write("s.obj", "usemtl one\n" + std::string(triangle) + "mtllib one.mtl\n"));
  EXPECT_EQ(loaded.desc.materials.size(), 1U);
  EXPECT_EQ(loaded.desc.materials[0].name, "one");
}

// Those of a material file are multiplied, unless a picture says which colour there is.
TEST(ObjFiles, MaterialsShowVertexColors) {
  const TemporaryFolder folder;
  folder.write("s.mtl", "newmtl red\nKd 0.5 0 0\nnewmtl painted\nmap_Kd missing.png\n");
  const Loaded loaded =
      load(folder.write("s.obj", "mtllib s.mtl\nv 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl red\n"
                                 "f 1 2 3\nusemtl painted\nf 1 2 3\n"));
  ASSERT_EQ(loaded.desc.materials.size(), 3U);
  const Material &red = loaded.desc.materials[0], &painted = loaded.desc.materials[1],
                 &plain = loaded.desc.materials[2];
  EXPECT_TRUE(red.vertex_colors);
  EXPECT_EQ(red.diffuse, Vec3(0.5F, 0, 0));
  EXPECT_FALSE(painted.vertex_colors);
  EXPECT_TRUE(plain.vertex_colors);
  EXPECT_EQ(plain.diffuse, Vec3(1.0F));
}

TEST(ObjFiles, MissingMaterialFilesAreWarnings) {
  const TemporaryFolder folder;
  const auto scene = folder.write("s.obj", std::string("mtllib missing.mtl\nmtllib a b.mtl\n") + triangle);
  const Loaded loaded = load(scene);
  ASSERT_EQ(loaded.warnings().size(), 3U);
  EXPECT_TRUE(contains(loaded.warnings()[0], "s.obj:1:1: material file 'missing.mtl' does not exist"));
  EXPECT_TRUE(contains(loaded.warnings()[2], "s.obj:2:1: material file 'b.mtl' does not exist"));
  LoadOptions strict;
  strict.strict = true;
  EXPECT_EQ(load_error(scene, strict), loaded.warnings()[0]);
}

TEST(ObjFiles, WarningsOfSeveralMaterialFilesAreCountedOnceEach) {
  const TemporaryFolder folder;
  std::string libraries, statements;
  for (int i = 0; i < 15; ++i) statements += "Kd -1 0 0\n";
  for (const char* name : {"a.mtl", "b.mtl", "c.mtl"}) {
    folder.write(name, "newmtl " + std::string(name) + '\n' + statements);
    libraries += "mtllib " + std::string(name) + '\n';
  }
  const Loaded loaded = load(folder.write("s.obj", libraries + triangle));
  EXPECT_EQ(loaded.diagnostics.count(), 45U);
  ASSERT_EQ(loaded.warnings().size(), 11U);
  EXPECT_TRUE(contains(loaded.warnings()[10], "35 more: ")) << loaded.warnings()[10];
}

TEST(ObjFiles, MaterialFilesOutsideTheFolderAreRefused) {
  const TemporaryFolder folder;
  folder.write("outside.mtl", "newmtl one\n");
  const auto absolute = folder.path() / "outside.mtl";
  std::filesystem::create_directories(folder.path() / "scene");
  std::filesystem::create_symlink("../outside.mtl", folder.path() / "scene/link.mtl");
  std::filesystem::create_symlink("..", folder.path() / "scene/up");
  LoadOptions allow;
  allow.allow_external_files = true;
  for (const std::string& name :
       {std::string("../outside.mtl"), absolute.string(), std::string("link.mtl"),
        std::string("up/outside.mtl"), std::string("x/../../outside.mtl"), std::string("..\\outside.mtl")}) {
    const auto scene = folder.write("scene/s.obj", "# here\nmtllib " + name + "\n" + triangle);
    EXPECT_TRUE(contains(load_error(scene), "s.obj:2:1: material file")) << name;
    EXPECT_TRUE(contains(load_error(scene), "outside the scene directory")) << name;
    if (name.find("x/") == std::string::npos) {
      EXPECT_EQ(load(scene, allow).desc.materials[0].name, "one") << name;
    }
  }
  for (const char* name : {"../../../etc/passwd", "/etc/passwd", "../does/not/exist.mtl"})
    EXPECT_TRUE(
        contains(load_error(folder.write("scene/s.obj", std::string("mtllib ") + name + "\n" + triangle)),
                 "outside the scene directory"));
}

TEST(ObjFiles, SpecialMaterialFilesAreRefused) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder.path() / "fifo.mtl").c_str(), 0600), 0);
  std::filesystem::create_directory(folder.path() / "dir.mtl");
  for (const char* name : {"fifo.mtl", "dir.mtl"})
    EXPECT_TRUE(contains(load_error(folder.write("s.obj", std::string("mtllib ") + name + "\n" + triangle)),
                         "is not a regular file"));
}

TEST(ObjFiles, ErrorsInMaterialFilesNameThem) {
  const TemporaryFolder folder;
  folder.write("bad.mtl", "newmtl a\n\nKd 1 x 0\n");
  const std::string text = std::string("mtllib bad.mtl\n") + triangle;
  EXPECT_EQ(load_error(folder.write("s.obj", text)),
            (folder.path() / "bad.mtl").string() + ":3:6: not a number: 'x'");
  // Whatever comes first in the scene is reported.
  EXPECT_TRUE(contains(load_error(folder.write("s.obj", text + "v 1\n")), "bad.mtl:3:6"));
  EXPECT_TRUE(contains(load_error(folder.write("s.obj", "v 1\n" + text)), "s.obj:1:1"));
}

TEST(ObjFiles, MaterialFilesAreCounted) {
  const TemporaryFolder folder;
  std::string text;
  for (std::size_t i = 0; i <= MaterialFiles::most_files; ++i) {
    const std::string name = "m" + std::to_string(i) + ".mtl";
    folder.write(name, "newmtl " + name + "\n");
    text += "mtllib " + name + "\n";
    if (i + 1 == MaterialFiles::most_files) {
      EXPECT_EQ(load(folder.write("s.obj", text + triangle)).desc.materials.size(),
                MaterialFiles::most_files + 1);
    }
  }
  EXPECT_TRUE(contains(load_error(folder.write("s.obj", text + triangle)),
                       "s.obj:1025:1: more than 1024 material files"));
}

TEST(ObjFiles, TexturesAreCheckedBeforeTheyAreOpened) {
  const TemporaryFolder folder;
  folder.write("scene/here.png", "no picture");
  folder.write("outside.png", "");
  ASSERT_EQ(::mkfifo((folder.path() / "scene/fifo.png").c_str(), 0600), 0);
  std::filesystem::create_symlink("../outside.png", folder.path() / "scene/link.png");
  folder.write("scene/t.mtl", "newmtl a\nmap_Kd .\\here.png\nmap_Ka missing.png\nmap_Ks ../outside.png\n"
                              "map_Ke link.png\nmap_d fifo.png\nbump /etc/shadow\n");
  const Loaded loaded = load(folder.write("scene/s.obj", std::string("mtllib t.mtl\nusemtl a\n") + triangle));
  const Material& material = loaded.desc.materials[0];
  EXPECT_EQ(loaded.desc.textures.at(material.diffuse_texture).kind, TextureKind::checker); // it shows
  for (const std::uint32_t id : {material.specular_texture, material.emission_texture,
                                 material.opacity_texture, material.bump_texture})
    EXPECT_EQ(id, no_texture);
  const auto lines = loaded.warnings();
  ASSERT_EQ(lines.size(), 6U);
  EXPECT_TRUE(contains(lines[0], "t.mtl:2:8: texture '.\\here.png' is no PNG, JPEG, EXR"));
  EXPECT_TRUE(contains(lines[1], "t.mtl:3:8: texture 'missing.png' does not exist"));
  EXPECT_TRUE(contains(lines[2], "t.mtl:4:8: texture '../outside.png' lies outside"));
  EXPECT_TRUE(contains(lines[3], "t.mtl:5:8: texture 'link.png' lies outside"));
  EXPECT_TRUE(contains(lines[4], "t.mtl:6:7: texture 'fifo.png' is no regular file"));
  EXPECT_TRUE(contains(lines[5], "t.mtl:7:6: texture '/etc/shadow' lies outside"));
}

TEST(ObjFiles, AnyNumberOfThreadsReadsTheSame) {
  const TemporaryFolder folder;
  std::string text;
  for (int i = 0; i < 60000; ++i) {
    text +=
        "v " + std::to_string(i) + " 0." + std::to_string(i * 7 % 1000) + ' ' + std::to_string(i % 13) + '\n';
    if (i > 2) text += "f -1 -2 " + std::to_string(i - 1) + '\n';
  }
  const auto path = folder.write("s.obj", text);
  LoadOptions options;
  options.threads = 1;
  const Loaded one = load(path, options);
  EXPECT_EQ(one.desc.triangles.size() + one.diagnostics.count(), 59997U);
  for (const int threads : {0, 2, 5, 1000}) {
    options.threads = threads;
    const Loaded many = load(path, options);
    EXPECT_TRUE(same_columns(one.desc, many.desc));
    EXPECT_EQ(one.warnings(), many.warnings());
  }
}

// A file that another process rewrites meanwhile gives a scene or an InputError.
TEST(ObjFiles, FilesThatChangeWhileReadDoNoHarm) {
  const TemporaryFolder folder;
  std::string text;
  for (int i = 0; i < 30000; ++i) text += "v 1.5 2.5 " + std::to_string(i) + '\n';
  for (int i = 0; i < 30000; ++i) text += "f 1 2 " + std::to_string(i + 1) + '\n';
  const auto path = folder.write("s.obj", text);
  std::atomic<bool> done = false;
  std::thread writer([&] {
    for (unsigned i = 0; !done; ++i) {
      if (i % 2 == 0) {
        std::error_code error;
        std::filesystem::resize_file(path, text.size() / 3, error);
      } else {
        std::ofstream(path, std::ios::binary) << text;
      }
    }
  });
  for (int i = 0; i < 40; ++i) {
    try {
      EXPECT_TRUE(is_sound(load(path).desc));
    } catch (const InputError&) {
      continue;
    }
  }
  done = true;
  writer.join();
}

} // namespace
} // namespace fastrt
