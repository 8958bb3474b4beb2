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

// The file as it grows, and where errors go.
struct Output {
  std::vector<unsigned char> bytes;
  EncodedPicture* result;
};

Output& output_of(exr_const_context_t context) {
  void* data = nullptr;
  exr_get_user_data(context, &data);
  return *static_cast<Output*>(data);
}

std::int64_t write_bytes(exr_const_context_t, void* data, const void* bytes, std::uint64_t count,
                         std::uint64_t offset, exr_stream_error_func_ptr_t) {
  std::vector<unsigned char>& file = static_cast<Output*>(data)->bytes;
  try {
    file.resize(std::max<std::size_t>(file.size(), offset + count));
  } catch (const std::exception&) {
    return -1;
  }
  std::memcpy(file.data() + offset, bytes, count);
  return static_cast<std::int64_t>(count);
}

void keep_error(exr_const_context_t context, exr_result_t, const char* message) {
  put_error(*output_of(context).result, message);
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

bool put_header(exr_context_t file, const LayersToEncode& layers, const std::vector<LayerChannel>& channels) {
  int part = 0;
  bool done = succeeds(exr_add_part(file, nullptr, EXR_STORAGE_SCANLINE, &part)) &&
              succeeds(exr_initialize_required_attr_simple(file, part, layers.width, layers.height,
                                                           EXR_COMPRESSION_ZIP)) &&
              succeeds(exr_attr_set_string(file, part, "Software", "fastrt"));
  if (layers.objects != nullptr)
    done = done && succeeds(exr_attr_set_string(file, part, "fastrt:objects", layers.objects));
  for (const LayerChannel& channel : channels)
    done = done && succeeds(exr_add_channel(file, part, channel.name,
                                            channel.is_integer != 0 ? EXR_PIXEL_UINT : EXR_PIXEL_FLOAT,
                                            EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1));
  return done && succeeds(exr_write_header(file));
}

bool encode(const LayersToEncode& layers, Output& output) {
  exr_context_initializer_t functions = EXR_DEFAULT_CONTEXT_INITIALIZER;
  functions.error_handler_fn = keep_error; // or it would print
  functions.user_data = &output;
  functions.write_fn = write_bytes;
  exr_context_t started = nullptr;
  if (!succeeds(exr_start_write(&started, "picture.exr", EXR_WRITE_FILE_DIRECTLY, &functions))) return false;
  Context file(started);
  const std::vector<LayerChannel> channels = in_order(layers);
  if (!put_header(file.get(), layers, channels)) return false;
  const std::vector<std::vector<unsigned char>> chunks = fastrt::zip_chunks(layers, channels);
  std::size_t size = output.bytes.size() + 8 * chunks.size();
  for (const auto& chunk : chunks) size += chunk.size() + 8;
  output.bytes.reserve(size);
  int y = 0;
  for (const auto& chunk : chunks) {
    if (!succeeds(exr_write_scanline_chunk(file.get(), 0, y, chunk.data(), chunk.size()))) return false;
    y += fastrt::rows_in_chunk;
  }
  exr_context_t finished = file.release();
  return succeeds(exr_finish(&finished)); // writes where the chunks are
}

int give(const std::vector<unsigned char>& bytes, EncodedPicture& result) {
  result.bytes = static_cast<unsigned char*>(std::malloc(bytes.size()));
  if (result.bytes == nullptr) {
    put_error(result, "out of memory");
    return 0;
  }
  std::memcpy(result.bytes, bytes.data(), bytes.size());
  result.count = bytes.size();
  return 1;
}

} // namespace

extern "C" __attribute__((visibility("default"))) int fastrt_openexr_encode_1(const LayersToEncode* layers,
                                                                              EncodedPicture* result) {
  try {
    Output output{{}, result};
    if (encode(*layers, output)) return give(output.bytes, *result);
    if (result->error[0] == '\0') put_error(*result, "OpenEXR gives no reason");
  } catch (const std::exception&) {
    put_error(*result, "out of memory");
  }
  return 0;
}
