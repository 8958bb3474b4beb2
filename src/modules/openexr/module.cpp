// SPDX-License-Identifier: Apache-2.0
// EXR files by OpenEXR's core library, whose C++ library would bring threads of its own.
#include "src/modules/openexr/zip.hpp"

#include <OpenEXR/openexr.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <string_view>
#include <type_traits>

namespace {

using fastrt::EncodedPicture;
using fastrt::LayerChannel;
using fastrt::LayersToEncode;

void put_error(EncodedPicture& result, std::string_view why) {
  const std::size_t count = std::min(why.size(), sizeof result.error - 1);
  std::memcpy(result.error, why.data(), count);
  result.error[count] = '\0';
}

// The file as it grows.
using Bytes = std::vector<unsigned char>;

std::int64_t write_bytes(exr_const_context_t, void* data, const void* bytes, std::uint64_t count,
                         std::uint64_t offset, exr_stream_error_func_ptr_t) {
  Bytes& file = *static_cast<Bytes*>(data);
  try {
    file.resize(std::max<std::size_t>(file.size(), offset + count));
  } catch (const std::exception&) {
    return -1;
  }
  std::memcpy(file.data() + offset, bytes, count);
  return static_cast<std::int64_t>(count);
}

// Where errors of this thread's file go. (To ask the context for it while it reports one would wait for ever:
// it is locked.)
thread_local EncodedPicture* current = nullptr;

void keep_error(exr_const_context_t, exr_result_t, const char* message) {
  if (current != nullptr) put_error(*current, message);
}

struct Finish {
  void operator()(exr_context_t context) const { exr_finish(&context); }
};
using Context = std::unique_ptr<std::remove_pointer_t<exr_context_t>, Finish>;

bool succeeds(exr_result_t result) { return result == EXR_ERR_SUCCESS; }

// Channels by their names, as files hold them.
std::vector<LayerChannel> in_order(const LayersToEncode& layers) {
  std::vector<LayerChannel> channels(layers.channels, layers.channels + layers.channel_count);
  std::sort(channels.begin(), channels.end(), [](const LayerChannel& a, const LayerChannel& b) {
    return std::string_view(a.name) < std::string_view(b.name);
  });
  return channels;
}

exr_attr_box2i_t window(int x, int y, int width, int height) {
  exr_attr_box2i_t box{};
  box.min.x = x;
  box.min.y = y;
  box.max.x = x + width - 1;
  box.max.y = y + height - 1;
  return box;
}

bool put_header(exr_context_t file, const LayersToEncode& layers, const std::vector<LayerChannel>& channels) {
  int part = 0;
  const exr_attr_box2i_t whole = window(0, 0, layers.whole_width, layers.whole_height);
  const exr_attr_box2i_t here = window(layers.x, layers.y, layers.width, layers.height);
  const exr_attr_v2f_t center{};
  bool done = succeeds(exr_add_part(file, nullptr, EXR_STORAGE_SCANLINE, &part)) &&
              succeeds(exr_initialize_required_attr(file, part, &whole, &here, 1, &center, 1,
                                                    EXR_LINEORDER_INCREASING_Y, EXR_COMPRESSION_ZIP)) &&
              succeeds(exr_attr_set_string(file, part, "Software", "fastrt"));
  if (layers.objects != nullptr)
    done = done && succeeds(exr_attr_set_string(file, part, "fastrt:objects", layers.objects));
  for (const LayerChannel& channel : channels)
    done = done && succeeds(exr_add_channel(file, part, channel.name,
                                            channel.is_integer != 0 ? EXR_PIXEL_UINT : EXR_PIXEL_FLOAT,
                                            EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1));
  return done && succeeds(exr_write_header(file));
}

bool encode(const LayersToEncode& layers, Bytes& bytes) {
  exr_context_initializer_t functions = EXR_DEFAULT_CONTEXT_INITIALIZER;
  functions.error_handler_fn = keep_error; // or it would print
  functions.user_data = &bytes;
  functions.write_fn = write_bytes;
  exr_context_t started = nullptr;
  if (!succeeds(exr_start_write(&started, "picture.exr", EXR_WRITE_FILE_DIRECTLY, &functions))) return false;
  Context file(started);
  const std::vector<LayerChannel> channels = in_order(layers);
  if (!put_header(file.get(), layers, channels)) return false;
  const std::vector<Bytes> chunks = fastrt::zip_chunks(layers, channels);
  std::size_t size = bytes.size() + 8 * chunks.size();
  for (const Bytes& chunk : chunks) size += chunk.size() + 8;
  bytes.reserve(size);
  int y = layers.y;
  for (const Bytes& chunk : chunks) {
    if (!succeeds(exr_write_scanline_chunk(file.get(), 0, y, chunk.data(), chunk.size()))) return false;
    y += fastrt::rows_in_chunk;
  }
  exr_context_t finished = file.release();
  return succeeds(exr_finish(&finished)); // writes where the chunks are
}

int give(const Bytes& bytes, EncodedPicture& result) {
  result.bytes = static_cast<unsigned char*>(std::malloc(bytes.size()));
  if (result.bytes == nullptr) {
    put_error(result, fastrt::out_of_memory);
    return 0;
  }
  std::memcpy(result.bytes, bytes.data(), bytes.size());
  result.count = bytes.size();
  return 1;
}

} // namespace

extern "C" __attribute__((visibility("default"))) int fastrt_openexr_encode_2(const LayersToEncode* layers,
                                                                              EncodedPicture* result) {
  current = result;
  int given = 0;
  try {
    Bytes bytes;
    if (encode(*layers, bytes))
      given = give(bytes, *result);
    else if (result->error[0] == '\0')
      put_error(*result, "OpenEXR gives no reason");
  } catch (const std::exception&) {
    put_error(*result, fastrt::out_of_memory);
  }
  current = nullptr;
  return given;
}
