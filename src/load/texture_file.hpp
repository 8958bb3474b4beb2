// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/load/scene_folder.hpp"

#include <fastrt/texture.hpp>

#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>

namespace fastrt {

// What the codes of a picture file stand for.
enum class TextureCode {
  color, // sRGB, unless the file holds linear numbers
  data,  // numbers as they are: heights, normals, opacities
};

struct TextureFile {
  std::shared_ptr<const Image> image; // null if it can't be used
  std::string fault;                  // "" if there is nothing to say; of damage too
};

// Reads a picture: PNG, JPEG, EXR, HDR, TGA, PNM, BMP or TIFF, told apart by their first bytes. Opens regular
// files alone. Throws nothing but std::bad_alloc.
TextureFile read_texture(const std::filesystem::path& path, TextureCode code);

// A file, and what its codes stand for.
using TextureKey = std::pair<std::filesystem::path, TextureCode>;

// Reads each file once, on so many threads.
std::map<TextureKey, TextureFile> read_textures(const std::set<TextureKey>& keys, int threads);

// What is said of a texture file that was found so; "" if it may be opened.
const char* texture_fault(SceneFolder::Finding finding);

// What a surface shows whose texture is missing: a checker of magenta and grey.
Texture missing_texture(const std::string& name);

} // namespace fastrt
