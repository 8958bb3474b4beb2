// SPDX-License-Identifier: Apache-2.0
// The functions of the modules for pictures, in plain types. OpenImageIO costs 0.2 s and 129 MB to load, so
// the library finds it with dlopen when a picture needs it, and nothing else knows of it. Textures that are
// PNG or usual JPEG files, and JPEG and EXR pictures, do not: libpng and libjpeg, and OpenEXR's core, in
// modules of their own, take a millisecond.
#pragma once

#include <cstddef>

namespace fastrt {

inline constexpr const char* oiio_module_file = "fastrt_oiio.so";
inline constexpr const char* oiio_encode_name = "fastrt_oiio_encode_5"; // the number changes with the types

// The error of a module that has not got the memory it asked for.
inline constexpr const char* out_of_memory = "out of memory";

struct PictureToEncode {
  const char* format; // an extension without the dot
  const void* pixels; // 3 * width * height values, rows from the top: of JPEG bytes, otherwise floats
  int width, height;
};

struct EncodedPicture {
  unsigned char* bytes; // made by malloc; the caller frees it
  std::size_t count;
  char error[256];
};

// Returns 1, or 0 with `error` set. Throws nothing. The module for PNG and JPEG makes JPEG, the one that
// holds OpenImageIO what has floats and is not EXR.
using PictureEncode = int(const PictureToEncode* picture, EncodedPicture* result);

// Numbers of four bytes, one a pixel, rows from the top.
struct LayerChannel {
  const char* name;
  const void* values;
  std::size_t stride; // from a pixel's number to the next one's, in numbers
  int is_integer;     // unsigned integers, otherwise floats
};

struct LayersToEncode {
  const LayerChannel* channels;
  int channel_count;
  int width, height;
  int x, y; // the first pixel's place in the whole picture
  int whole_width, whole_height;
  int threads;
  const char* objects; // the file's attribute "fastrt:objects", or null
};

inline constexpr const char* openexr_module_file = "fastrt_openexr.so";
inline constexpr const char* openexr_encode_name = "fastrt_openexr_encode_2";

// An EXR file; else as PictureEncode.
using LayersEncode = int(const LayersToEncode* layers, EncodedPicture* result);

inline constexpr const char* oiio_decode_name = "fastrt_oiio_decode_1";
inline constexpr const char* png_jpeg_module_file = "fastrt_png_jpeg.so";
inline constexpr const char* png_jpeg_decode_name = "fastrt_png_jpeg_decode_2";
inline constexpr const char* png_jpeg_encode_name = "fastrt_png_jpeg_encode_3";

// A whole file in memory.
struct PictureFile {
  const char* format; // OpenImageIO's name of it
  const unsigned char* bytes;
  std::size_t count;
  int most_side;          // refuse pictures that are wider or higher
  std::size_t most_bytes; // and those whose pixels take more
};

struct DecodedPicture {
  void* rgba;    // made by malloc, the caller frees it: four floats or bytes a pixel, rows from the top
  int is_float;  // floats, otherwise bytes
  int is_linear; // the file holds linear numbers, not codes
  int width, height;
  int is_damaged;  // not all of it could be read; what is missing is black
  char error[256]; // of damage too
};

// Returns 1, or 0: with `error` set, or of unusual JPEG files without, which OpenImageIO may read. Throws
// nothing.
using PictureDecode = int(const PictureFile* file, DecodedPicture* texture);

} // namespace fastrt
