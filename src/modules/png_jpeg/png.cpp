// SPDX-License-Identifier: Apache-2.0
#include "src/modules/png_jpeg/codecs.hpp"

#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace fastrt {
namespace {

// Of a pixel: red, green, blue and alpha.
constexpr std::size_t channels = 4;

struct Bytes {
  const unsigned char* at;
  std::size_t left;
};

// What must be freed however reading ends: libpng's errors jump. why: what it had to say.
struct PngReader {
  png_structp png = nullptr;
  png_infop info = nullptr;
  Bytes bytes{};
  unsigned char* rgba = nullptr;
  std::size_t width = 0, height = 0, rows = 0; // rows: that hold pixels
  bool is_deep = false;                        // 16 bits
  char why[sizeof DecodedPicture::error]{};
};

void take_bytes(png_structp png, png_bytep to, png_size_t count) {
  auto& bytes = *static_cast<Bytes*>(png_get_io_ptr(png));
  if (count > bytes.left) png_error(png, "the file ends early");
  std::memcpy(to, bytes.at, count);
  bytes.at += count;
  bytes.left -= count;
}

[[noreturn]] void give_up(png_structp png, png_const_charp why) {
  auto& reader = *static_cast<PngReader*>(png_get_error_ptr(png));
  std::strncpy(reader.why, why, sizeof reader.why - 1);
  png_longjmp(png, 1);
}
void say_nothing(png_structp /*png*/, png_const_charp /*what*/) {}

// Rows are to be codes of red, green, blue and alpha: bytes, or words where the file has these.
void ask_for_rgba(const PngReader& reader) {
  png_structp png = reader.png;
  const int type = png_get_color_type(png, reader.info);
  const bool has_transparent_color = png_get_valid(png, reader.info, PNG_INFO_tRNS) != 0;
  png_set_expand(png); // palettes, greys of few bits and a transparent colour
  if ((type & PNG_COLOR_MASK_COLOR) == 0) png_set_gray_to_rgb(png);
  if ((type & PNG_COLOR_MASK_ALPHA) == 0 && !has_transparent_color)
    png_set_add_alpha(png, 0xFFFF, PNG_FILLER_AFTER);
  if (reader.is_deep) png_set_swap(png);
}

// Words lie in the second half of the memory of the floats that they become.
unsigned char* codes_of(const PngReader& reader) {
  return reader.rgba + (reader.is_deep ? 2 * channels * reader.width * reader.height : 0);
}

void blacken_the_rest(PngReader& reader) {
  const std::size_t code_size = reader.is_deep ? 2 : 1, row = channels * code_size * reader.width;
  blacken(codes_of(reader) + row * reader.rows, reader.width * (reader.height - reader.rows), code_size);
  reader.rows = reader.height;
}

// False with reader.why; what has been read so far is kept.
bool read(const PictureFile& file, PngReader& reader) {
  png_structp png = reader.png;
  if (setjmp(png_jmpbuf(png)) != 0) return false; // NOLINT(cert-err52-cpp): libpng's way
  png_set_read_fn(png, &reader.bytes, take_bytes);
  png_read_info(png, reader.info);
  reader.width = png_get_image_width(png, reader.info);
  reader.height = png_get_image_height(png, reader.info);
  reader.is_deep = png_get_bit_depth(png, reader.info) == 16;
  const std::size_t code_size = reader.is_deep ? 2 : 1, value_size = reader.is_deep ? sizeof(float) : 1;
  if (!check_size(file, reader.width, reader.height, channels * value_size, reader.why)) return false;
  ask_for_rgba(reader);
  const int passes = png_set_interlace_handling(png);
  png_read_update_info(png, reader.info);
  const std::size_t row = channels * code_size * reader.width;
  if (png_get_rowbytes(png, reader.info) != row) png_error(png, "its rows have an unexpected size");
  reader.rgba =
      static_cast<unsigned char*>(std::malloc(reader.width * reader.height * value_size * channels));
  if (reader.rgba == nullptr) png_error(png, out_of_memory);
  if (passes > 1) blacken_the_rest(reader); // each pass fills in some pixels of the rows
  for (int pass = 0; pass < passes; ++pass)
    for (std::size_t y = 0; y < reader.height; ++y) {
      png_read_row(png, codes_of(reader) + y * row, nullptr);
      reader.rows = std::max(reader.rows, y + 1);
    }
  png_read_end(png, nullptr);
  return true;
}

// Words become floats from 0 to 1. Each float ends before the words that are still to be read.
void make_floats(PngReader& reader) {
  const std::size_t count = channels * reader.width * reader.height;
  for (std::size_t i = 0; i < count; ++i) {
    std::uint16_t word = 0;
    std::memcpy(&word, codes_of(reader) + sizeof word * i, sizeof word);
    const float value = static_cast<float>(word) * (1.0F / 65535);
    std::memcpy(reader.rgba + sizeof value * i, &value, sizeof value);
  }
}

} // namespace

bool decode_png(const PictureFile& file, DecodedPicture& picture) noexcept {
  PngReader reader;
  reader.bytes = {file.bytes, file.count};
  reader.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reader, give_up, say_nothing);
  if (reader.png != nullptr) reader.info = png_create_info_struct(reader.png);
  if (reader.info == nullptr) std::strcpy(reader.why, out_of_memory);
  const bool whole = reader.info != nullptr && read(file, reader);
  png_destroy_read_struct(&reader.png, &reader.info, nullptr);
  std::memcpy(picture.error, reader.why, sizeof reader.why);
  if (reader.rgba == nullptr) return false;
  if (!whole) blacken_the_rest(reader);
  if (reader.is_deep) make_floats(reader);
  picture.rgba = reader.rgba;
  picture.is_float = reader.is_deep ? 1 : 0;
  picture.is_damaged = whole ? 0 : 1;
  picture.width = static_cast<int>(reader.width);
  picture.height = static_cast<int>(reader.height);
  return true;
}

} // namespace fastrt
