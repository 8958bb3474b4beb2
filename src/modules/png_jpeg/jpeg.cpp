// SPDX-License-Identifier: Apache-2.0
#include "src/modules/png_jpeg/codecs.hpp"

#include <csetjmp>
#include <cstdio>
#include <cstdlib>

// clang-format off: it takes <cstdio> for granted
#include <jpeglib.h>
// clang-format on

#ifndef JCS_ALPHA_EXTENSIONS
#error "libjpeg-turbo is needed: it writes red, green, blue and alpha"
#endif

namespace fastrt {
namespace {

// What must be freed however reading ends: libjpeg's errors jump.
struct JpegReader {
  jpeg_decompress_struct jpeg{};
  jpeg_error_mgr errors{};
  std::jmp_buf on_error{};
  unsigned char* rgba = nullptr;
};

[[noreturn]] void give_up(j_common_ptr jpeg) {
  std::longjmp(static_cast<JpegReader*>(jpeg->client_data)->on_error, 1); // NOLINT(cert-err52-cpp): its way
}
void say_nothing(j_common_ptr /*jpeg*/) {}

bool is_usual(const jpeg_decompress_struct& jpeg) {
  return jpeg.data_precision == 8 && (jpeg.jpeg_color_space == JCS_GRAYSCALE ||
                                      jpeg.jpeg_color_space == JCS_YCbCr || jpeg.jpeg_color_space == JCS_RGB);
}

bool read(const PictureFile& file, JpegReader& reader) {
  jpeg_decompress_struct& jpeg = reader.jpeg;
  if (setjmp(reader.on_error) != 0) return false; // NOLINT(cert-err52-cpp): libjpeg's way
  jpeg_create_decompress(&jpeg);
  jpeg_mem_src(&jpeg, file.bytes, static_cast<unsigned long>(file.count));
  jpeg_read_header(&jpeg, TRUE);
  if (!is_usual(jpeg) || !within_limits(file, jpeg.image_width, jpeg.image_height)) return false;
  jpeg.out_color_space = JCS_EXT_RGBA;
  jpeg_start_decompress(&jpeg);
  const std::size_t row = std::size_t{4} * jpeg.output_width;
  reader.rgba = static_cast<unsigned char*>(std::malloc(row * jpeg.output_height));
  if (reader.rgba == nullptr) return false;
  while (jpeg.output_scanline < jpeg.output_height) {
    unsigned char* to = reader.rgba + jpeg.output_scanline * row;
    jpeg_read_scanlines(&jpeg, &to, 1);
  }
  jpeg_finish_decompress(&jpeg);
  return jpeg.err->num_warnings == 0;
}

// The same of writing.
struct JpegWriter {
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors{};
  std::jmp_buf on_error{};
  unsigned char* bytes = nullptr;
  unsigned long count = 0;
};

[[noreturn]] void give_up_writing(j_common_ptr jpeg) {
  std::longjmp(static_cast<JpegWriter*>(jpeg->client_data)->on_error, 1); // NOLINT(cert-err52-cpp): its way
}

// Renders have sharp edges in colour too: it has as many values as brightness.
void ask_for_quality(jpeg_compress_struct& jpeg) {
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, 95, TRUE);
  for (int c = 0; c < jpeg.num_components; ++c)
    jpeg.comp_info[c].h_samp_factor = jpeg.comp_info[c].v_samp_factor = 1;
}

bool write(const PictureToEncode& picture, JpegWriter& writer) {
  jpeg_compress_struct& jpeg = writer.jpeg;
  if (setjmp(writer.on_error) != 0) return false; // NOLINT(cert-err52-cpp): libjpeg's way
  jpeg_create_compress(&jpeg);
  jpeg_mem_dest(&jpeg, &writer.bytes, &writer.count);
  jpeg.image_width = static_cast<JDIMENSION>(picture.width);
  jpeg.image_height = static_cast<JDIMENSION>(picture.height);
  jpeg.input_components = 3;
  jpeg.in_color_space = JCS_RGB;
  ask_for_quality(jpeg);
  jpeg_start_compress(&jpeg, TRUE);
  constexpr unsigned char made_by[] = {'f', 'a', 's', 't', 'r', 't'};
  jpeg_write_marker(&jpeg, JPEG_COM, made_by, sizeof made_by);
  const auto* const rows = static_cast<const unsigned char*>(picture.pixels);
  while (jpeg.next_scanline < jpeg.image_height) {
    const unsigned char* row = rows + std::size_t{3} * jpeg.image_width * jpeg.next_scanline;
    auto* from = const_cast<unsigned char*>(row); // which libjpeg only reads
    jpeg_write_scanlines(&jpeg, &from, 1);
  }
  jpeg_finish_compress(&jpeg);
  return true;
}

} // namespace

bool encode_jpeg(const PictureToEncode& picture, EncodedPicture& result) noexcept {
  if (picture.is_float != 0 || picture.channels != 3 || picture.channel_names != nullptr) return false;
  JpegWriter writer;
  writer.jpeg.err = jpeg_std_error(&writer.errors);
  writer.errors.error_exit = give_up_writing;
  writer.errors.output_message = say_nothing;
  writer.jpeg.client_data = &writer;
  const bool done = write(picture, writer);
  jpeg_destroy_compress(&writer.jpeg);
  if (!done) {
    std::free(writer.bytes);
    return false;
  }
  result.bytes = writer.bytes;
  result.count = writer.count;
  return true;
}

bool decode_jpeg(const PictureFile& file, DecodedPicture& picture) noexcept {
  JpegReader reader;
  reader.jpeg.err = jpeg_std_error(&reader.errors);
  reader.errors.error_exit = give_up;
  reader.errors.output_message = say_nothing;
  reader.jpeg.client_data = &reader;
  const bool done = read(file, reader);
  if (done) {
    picture.rgba = reader.rgba;
    picture.width = static_cast<int>(reader.jpeg.output_width);
    picture.height = static_cast<int>(reader.jpeg.output_height);
  } else {
    std::free(reader.rgba);
  }
  jpeg_destroy_decompress(&reader.jpeg);
  return done;
}

} // namespace fastrt
