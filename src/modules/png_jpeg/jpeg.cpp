// SPDX-License-Identifier: Apache-2.0
#include "src/modules/png_jpeg/codecs.hpp"

#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <cstring>

// They take <cstdio>, and the second one the first, for granted.
// clang-format off
#include <jpeglib.h>
#include <jerror.h>
// clang-format on

#ifndef JCS_ALPHA_EXTENSIONS
#error "libjpeg-turbo is needed: it writes red, green, blue and alpha"
#endif

namespace fastrt {
namespace {

// libjpeg's errors jump to on_error; why: what it had to say, of the first warning or the error.
struct JpegErrors {
  jpeg_error_mgr manager{};
  std::jmp_buf on_error{};
  char why[JMSG_LENGTH_MAX]{};
  static_assert(sizeof why <= sizeof DecodedPicture::error);
};

[[noreturn]] void give_up(j_common_ptr jpeg) {
  auto& errors = *static_cast<JpegErrors*>(jpeg->client_data);
  jpeg->err->format_message(jpeg, errors.why);
  std::longjmp(errors.on_error, 1); // NOLINT(cert-err52-cpp): libjpeg's way
}
void note_warning(j_common_ptr jpeg, int level) {
  if (level >= 0) return; // no more than a remark
  if (jpeg->err->num_warnings++ == 0)
    jpeg->err->format_message(jpeg, static_cast<JpegErrors*>(jpeg->client_data)->why);
}

// Before jpeg_create_...(), which keeps them.
template <class Jpeg>
void catch_errors(Jpeg& jpeg, JpegErrors& errors) {
  jpeg.err = jpeg_std_error(&errors.manager);
  errors.manager.error_exit = give_up;
  errors.manager.emit_message = note_warning;
  jpeg.client_data = &errors;
}

// What must be freed however reading ends.
struct JpegReader : JpegErrors {
  jpeg_decompress_struct jpeg{};
  unsigned char* rgba = nullptr;
  std::size_t width = 0, height = 0, rows = 0; // rows: that have been read
  bool is_unusual = false;
};

bool is_usual(const jpeg_decompress_struct& jpeg) {
  return jpeg.data_precision == 8 && (jpeg.jpeg_color_space == JCS_GRAYSCALE ||
                                      jpeg.jpeg_color_space == JCS_YCbCr || jpeg.jpeg_color_space == JCS_RGB);
}

// False if not all could be read, with reader.why; what could is kept.
bool read(const PictureFile& file, JpegReader& reader) {
  jpeg_decompress_struct& jpeg = reader.jpeg;
  if (setjmp(reader.on_error) != 0) return false; // NOLINT(cert-err52-cpp): libjpeg's way
  jpeg_create_decompress(&jpeg);
  jpeg_mem_src(&jpeg, file.bytes, static_cast<unsigned long>(file.count));
  jpeg_read_header(&jpeg, TRUE);
  reader.width = jpeg.image_width;
  reader.height = jpeg.image_height;
  reader.is_unusual = !is_usual(jpeg);
  if (reader.is_unusual || !check_size(file, reader.width, reader.height, 4, reader.why)) return false;
  jpeg.out_color_space = JCS_EXT_RGBA;
  jpeg_start_decompress(&jpeg);
  reader.rgba = static_cast<unsigned char*>(std::malloc(4 * reader.width * reader.height));
  if (reader.rgba == nullptr) ERREXIT1(&jpeg, JERR_OUT_OF_MEMORY, 0);
  while (jpeg.output_scanline < jpeg.output_height) {
    unsigned char* to = reader.rgba + jpeg.output_scanline * 4 * reader.width;
    jpeg_read_scanlines(&jpeg, &to, 1);
    reader.rows = jpeg.output_scanline;
  }
  jpeg_finish_decompress(&jpeg);
  return jpeg.err->num_warnings == 0;
}

// The same of writing. (libjpeg's own target in memory does not say what is to be freed after an error.)
struct JpegWriter : JpegErrors {
  jpeg_compress_struct jpeg{};
  jpeg_destination_mgr target{};
  unsigned char* bytes = nullptr;
  std::size_t size = 0, count = 0; // of the memory, and of it what is written in the end
};

JpegWriter& writer_of(j_compress_ptr jpeg) {
  return static_cast<JpegWriter&>(*static_cast<JpegErrors*>(jpeg->client_data));
}

// More memory, when all there is has been filled.
void grow(j_compress_ptr jpeg) {
  JpegWriter& writer = writer_of(jpeg);
  const std::size_t size = writer.size == 0 ? std::size_t{1} << 16U : 2 * writer.size;
  void* const bytes = std::realloc(writer.bytes, size);
  if (bytes == nullptr) ERREXIT1(jpeg, JERR_OUT_OF_MEMORY, 0);
  writer.bytes = static_cast<unsigned char*>(bytes);
  writer.target.next_output_byte = writer.bytes + writer.size;
  writer.target.free_in_buffer = size - writer.size;
  writer.size = size;
}
boolean grow_and_go_on(j_compress_ptr jpeg) {
  grow(jpeg);
  return TRUE;
}
void note_count(j_compress_ptr jpeg) {
  JpegWriter& writer = writer_of(jpeg);
  writer.count = writer.size - writer.target.free_in_buffer;
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
  writer.target.init_destination = grow;
  writer.target.empty_output_buffer = grow_and_go_on;
  writer.target.term_destination = note_count;
  jpeg.dest = &writer.target;
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

bool decode_jpeg(const PictureFile& file, DecodedPicture& picture) noexcept {
  JpegReader reader;
  catch_errors(reader.jpeg, reader);
  const bool whole = read(file, reader);
  jpeg_destroy_decompress(&reader.jpeg);
  if (!reader.is_unusual) std::memcpy(picture.error, reader.why, sizeof reader.why);
  if (reader.rgba == nullptr) return false;
  if (!whole)
    blacken(reader.rgba + 4 * reader.width * reader.rows, reader.width * (reader.height - reader.rows), 1);
  picture.rgba = reader.rgba;
  picture.is_damaged = whole ? 0 : 1;
  picture.width = static_cast<int>(reader.width);
  picture.height = static_cast<int>(reader.height);
  return true;
}

bool encode_jpeg(const PictureToEncode& picture, EncodedPicture& result) noexcept {
  JpegWriter writer;
  catch_errors(writer.jpeg, writer);
  const bool done = write(picture, writer);
  jpeg_destroy_compress(&writer.jpeg);
  if (done) {
    result.bytes = writer.bytes;
    result.count = writer.count;
  } else {
    std::free(writer.bytes);
    std::strncpy(result.error, writer.why, sizeof result.error - 1);
  }
  return done;
}

} // namespace fastrt
