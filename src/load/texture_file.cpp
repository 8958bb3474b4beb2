// SPDX-License-Identifier: Apache-2.0
#include "src/load/texture_file.hpp"

#include "src/load/parallel_for.hpp"
#include "src/load/source.hpp"
#include "src/load/text.hpp"
#include "src/modules/open.hpp"
#include "src/modules/pictures.hpp"
#include "src/scene/printable.hpp"
#include "src/scene/srgb_curve.hpp"

#include <fastrt/error.hpp>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace fastrt {

namespace {

// Of a file, and of a picture's pixels.
constexpr std::size_t most_bytes = std::size_t{1} << 30U;

struct Free {
  void operator()(void* memory) const { std::free(memory); }
};

// OpenImageIO's name of the format that a file begins like; "" if it is none that is read here. TGA has no
// such mark.
const char* format_of(std::string_view bytes, const std::filesystem::path& path) {
  using namespace std::string_view_literals;
  static constexpr std::array<std::pair<std::string_view, const char*>, 10> marks = {
      {{"\x89PNG\r\n\x1A\n"sv, "png"},
       {"\xFF\xD8\xFF"sv, "jpeg"},
       {"\x76\x2F\x31\x01"sv, "openexr"},
       {"#?RADIANCE"sv, "hdr"},
       {"#?RGBE"sv, "hdr"},
       {"BM"sv, "bmp"},
       {"II*\0"sv, "tiff"},
       {"MM\0*"sv, "tiff"},
       {"II+\0"sv, "tiff"},
       {"MM\0+"sv, "tiff"}}};
  for (const auto& [mark, name] : marks)
    if (bytes.starts_with(mark)) return name;
  const bool is_pnm = bytes.size() > 2 && bytes[0] == 'P' &&
                      std::string_view("123456fF").find(bytes[1]) != std::string_view::npos &&
                      std::string_view(" \t\r\n#").find(bytes[2]) != std::string_view::npos;
  if (is_pnm) return "pnm";
  return lower_case(path.extension().string()) == ".tga" ? "targa" : "";
}

std::string contents_of(const std::filesystem::path& path) {
  const Source source = Source::open(path);
  if (source.size() > most_bytes) throw InputError("it is larger than 1 GiB");
  std::string bytes(source.size(), '\0');
  source.read(0, bytes.data(), bytes.size());
  return bytes;
}

Image image_of(const DecodedPicture& read, TextureCode code) {
  const std::size_t count = 4 * static_cast<std::size_t>(read.width) * static_cast<std::size_t>(read.height);
  if (read.is_float == 0)
    return {read.width, read.height, std::span(static_cast<const std::uint8_t*>(read.rgba), count),
            code == TextureCode::color};
  auto* const values = static_cast<float*>(read.rgba);
  if (read.is_linear == 0 && code == TextureCode::color)
    for (std::size_t i = 0; i < count; ++i)
      if (i % 4 != 3) values[i] = linear_of_srgb(values[i]);
  return {read.width, read.height, std::span<const float>(values, count)};
}

// Whether nothing of a damaged picture could be read.
bool is_black(const DecodedPicture& read) {
  const std::size_t pixels = static_cast<std::size_t>(read.width) * static_cast<std::size_t>(read.height);
  const auto no_colour = [&](const auto* rgba) {
    for (std::size_t i = 0; i < 4 * pixels; ++i)
      if (i % 4 != 3 && rgba[i] != 0) return false;
    return true;
  };
  return read.is_float != 0 ? no_colour(static_cast<const float*>(read.rgba))
                            : no_colour(static_cast<const std::uint8_t*>(read.rgba));
}

// "" if done, else why not; nothing where another module may know more.
std::optional<std::string> decode_with(const ModuleFunction& module, const PictureFile& file,
                                       DecodedPicture& read) {
  if (module.function == nullptr) return module.fault;
  if (reinterpret_cast<PictureDecode*>(module.function)(&file, &read) != 0) return "";
  if (read.error[0] == '\0') return {};
  return read.error;
}

// "" if done, else why not. (OpenImageIO would print what is wrong with a PNG.)
std::string decode(const PictureFile& file, DecodedPicture& read) {
  const std::string_view format = file.format;
  if (format == "png" || format == "jpeg")
    if (const auto done = decode_with(find_png_jpeg_function(png_jpeg_decode_name), file, read)) return *done;
  return decode_with(find_oiio_function(oiio_decode_name), file, read).value_or("no reason is given");
}

} // namespace

TextureFile read_texture(const std::filesystem::path& path, TextureCode code) {
  try {
    const std::string bytes = contents_of(path);
    const std::string format = format_of(bytes, path);
    if (format.empty()) return {nullptr, "is no PNG, JPEG, EXR, HDR, TGA, PNM, BMP or TIFF picture"};
    const PictureFile file{format.c_str(), reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(),
                           max_image_side, most_bytes};
    DecodedPicture read{};
    const std::string why_not = decode(file, read);
    const std::unique_ptr<void, Free> rgba(read.rgba);
    if (why_not == out_of_memory) throw std::bad_alloc();
    if (!why_not.empty()) return {nullptr, "can't be read: " + printable(why_not)};
    if (read.is_damaged != 0 && is_black(read)) return {nullptr, "can't be read: " + printable(read.error)};
    const std::string fault = read.is_damaged != 0 ? "is damaged: " + printable(read.error) : "";
    return {std::make_shared<const Image>(image_of(read, code)), fault};
  } catch (const InputError& error) {
    return {nullptr, std::string("can't be read: ") + error.what()};
  }
}

std::map<TextureKey, TextureFile> read_textures(const std::set<TextureKey>& keys, int threads) {
  std::map<TextureKey, TextureFile> files;
  for (const TextureKey& key : keys) files.try_emplace(key);
  std::vector<std::pair<const TextureKey, TextureFile>*> all;
  for (auto& file : files) all.push_back(&file);
  if (!all.empty())
    parallel_for(all.size(), threads, [&](std::size_t i, std::size_t) {
      auto& [key, file] = *all[i];
      file = read_texture(key.first, key.second);
    });
  return files;
}

const char* texture_fault(SceneFolder::Finding finding) {
  switch (finding) {
  case SceneFolder::Finding::regular:
    return "";
  case SceneFolder::Finding::missing:
    return "does not exist";
  case SceneFolder::Finding::outside:
    return "lies outside the scene directory, and external files are not allowed; it is not used";
  default:
    return "is no regular file; it is not used";
  }
}

Texture missing_texture(const std::string& name) {
  Texture texture;
  texture.name = name;
  texture.kind = TextureKind::checker;
  texture.color_a = {1, 0, 1, 1};
  texture.color_b = {0.25F, 0.25F, 0.25F, 1};
  texture.scale = Vec2(8.0F);
  return texture;
}

} // namespace fastrt
