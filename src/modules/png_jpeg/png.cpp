// SPDX-License-Identifier: Apache-2.0
#include "src/modules/png_jpeg/codecs.hpp"

#include <png.h>

#include <csetjmp>
#include <cstdlib>
#include <cstring>

namespace fastrt {
namespace {

// What must be freed however reading ends: libpng's errors jump.
struct PngReader {
  png_structp png = nullptr;
  png_infop info = nullptr;
  unsigned char* rgba = nullptr;
  std::size_t width = 0, height = 0;
};

struct Bytes {
  const unsigned char* at;
  std::size_t left;
};

void take_bytes(png_structp png, png_bytep to, png_size_t count) {
  auto& bytes = *static_cast<Bytes*>(png_get_io_ptr(png));
  if (count > bytes.left) png_error(png, "the file ends early");
  std::memcpy(to, bytes.at, count);
  bytes.at += count;
  bytes.left -= count;
}

[[noreturn]] void give_up(png_structp png, png_const_charp /*why*/) { png_longjmp(png, 1); }
void say_nothing(png_structp /*png*/, png_const_charp /*what*/) {}

// Whether the file is of a kind that is read here; then rows will be bytes of red, green, blue and alpha.
bool ask_for_rgba(png_structp png, png_infop info) {
  const int type = png_get_color_type(png, info), depth = png_get_bit_depth(png, info);
  const bool is_palette = type == PNG_COLOR_TYPE_PALETTE;
  if ((!is_palette && depth != 8) || png_get_valid(png, info, PNG_INFO_tRNS) != 0) return false;
  if (is_palette) png_set_palette_to_rgb(png);
  if ((type & PNG_COLOR_MASK_COLOR) == 0) png_set_gray_to_rgb(png);
  if ((type & PNG_COLOR_MASK_ALPHA) == 0) png_set_add_alpha(png, 0xFF, PNG_FILLER_AFTER);
  return true;
}

bool read(const PictureFile& file, Bytes& bytes, PngReader& reader) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false; // NOLINT(cert-err52-cpp): libpng's way
  png_set_read_fn(reader.png, &bytes, take_bytes);
  png_read_info(reader.png, reader.info);
  reader.width = png_get_image_width(reader.png, reader.info);
  reader.height = png_get_image_height(reader.png, reader.info);
  if (!within_limits(file, reader.width, reader.height) || !ask_for_rgba(reader.png, reader.info))
    return false;
  const int passes = png_set_interlace_handling(reader.png);
  png_read_update_info(reader.png, reader.info);
  const std::size_t row = 4 * reader.width;
  if (png_get_rowbytes(reader.png, reader.info) != row) return false;
  reader.rgba = static_cast<unsigned char*>(std::malloc(row * reader.height));
  if (reader.rgba == nullptr) return false;
  for (int pass = 0; pass < passes; ++pass)
    for (std::size_t y = 0; y < reader.height; ++y) png_read_row(reader.png, reader.rgba + y * row, nullptr);
  png_read_end(reader.png, nullptr);
  return true;
}

} // namespace

bool decode_png(const PictureFile& file, DecodedPicture& picture) noexcept {
  PngReader reader;
  Bytes bytes{file.bytes, file.count};
  reader.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, give_up, say_nothing);
  if (reader.png == nullptr) return false;
  reader.info = png_create_info_struct(reader.png);
  const bool done = reader.info != nullptr && read(file, bytes, reader);
  png_destroy_read_struct(&reader.png, &reader.info, nullptr);
  if (!done) {
    std::free(reader.rgba);
    return false;
  }
  picture.rgba = reader.rgba;
  picture.width = static_cast<int>(reader.width);
  picture.height = static_cast<int>(reader.height);
  return true;
}

} // namespace fastrt
