// SPDX-License-Identifier: Apache-2.0
// Reads a picture with OpenImageIO, for image_formats_test: a module, so that the test programs themselves
// need not link it.
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

// Returns the number of values of the picture in `file`, 0 if it can't be read; fills at most `capacity` of
// them. Bytes come as value / 255.
extern "C" std::size_t read_picture(const char* file, float* values, std::size_t capacity, int* width,
                                    int* height) {
  const auto input = OIIO::ImageInput::open(file);
  if (!input) return 0;
  const OIIO::ImageSpec& spec = input->spec();
  *width = spec.width;
  *height = spec.height;
  const std::size_t count = spec.image_pixels() * static_cast<std::size_t>(spec.nchannels);
  if (count > capacity) return count;
  return input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values) ? count : 0;
}

// The file's data window: x, y, width, height; then its display window. 0 if it can't be read.
extern "C" int read_windows(const char* file, int* windows) {
  const auto input = OIIO::ImageInput::open(file);
  if (!input) return 0;
  const OIIO::ImageSpec& spec = input->spec();
  const int found[8] = {spec.x,      spec.y,      spec.width,      spec.height,
                        spec.full_x, spec.full_y, spec.full_width, spec.full_height};
  std::copy(found, found + 8, windows);
  return 1;
}

// An attribute of a file, cut off at `capacity` with its end; 0 if there is none.
extern "C" int read_attribute(const char* file, const char* name, char* text, std::size_t capacity) {
  const auto input = OIIO::ImageInput::open(file);
  if (!input) return 0;
  const std::string found(input->spec().get_string_attribute(name));
  const std::size_t count = std::min(found.size(), capacity - 1);
  found.copy(text, count);
  text[count] = '\0';
  return found.empty() ? 0 : 1;
}

// The bits of one channel of 32 bits, `count` pixels; 0 if the file has none of this name, type and size.
extern "C" int read_channel(const char* file, const char* name, int integer, std::uint32_t* bits,
                            std::size_t count) {
  const auto input = OIIO::ImageInput::open(file);
  if (!input) return 0;
  const OIIO::ImageSpec& spec = input->spec();
  const int channel = spec.channelindex(name);
  if (channel < 0 || spec.image_pixels() != count) return 0;
  const OIIO::TypeDesc type = integer != 0 ? OIIO::TypeDesc::UINT32 : OIIO::TypeDesc::FLOAT;
  if (spec.channelformat(channel) != type) return 0;
  return input->read_image(0, 0, channel, channel + 1, type, bits) ? 1 : 0;
}
