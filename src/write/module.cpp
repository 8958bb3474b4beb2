// SPDX-License-Identifier: Apache-2.0
// The formats that modules write: JPEG, EXR, and those of OpenImageIO.
#include "src/modules/open.hpp"
#include "src/modules/pictures.hpp"
#include "src/scene/printable.hpp"
#include "src/scene/threads.hpp"
#include "src/write/formats.hpp"

#include <fastrt/error.hpp>
#include <fastrt/write.hpp>

#include <cstdlib>
#include <memory>
#include <new>
#include <string_view>

namespace fastrt {

namespace {

template <class Encode>
Encode* loaded(const ModuleFunction& found) {
  if (found.function == nullptr)
    throw OutputError("cannot load the module for this picture format: " + printable(found.fault));
  return reinterpret_cast<Encode*>(found.function);
}

PictureEncode* find_encoder(std::string_view format) {
  return loaded<PictureEncode>(is_jpeg(format) ? find_png_jpeg_function(png_jpeg_encode_name)
                                               : find_oiio_function(oiio_encode_name));
}

struct Free {
  void operator()(unsigned char* bytes) const { std::free(bytes); }
};

template <class Request>
Bytes encode(int (*encoder)(const Request*, EncodedPicture*), const Request& request, const char* format) {
  EncodedPicture result{};
  const bool done = encoder(&request, &result) != 0;
  const std::unique_ptr<unsigned char, Free> bytes(result.bytes);
  if (!done && std::string_view(result.error) == out_of_memory) throw std::bad_alloc();
  if (!done)
    throw OutputError(std::string("cannot encode the picture as ") + format + ": " + printable(result.error));
  return {bytes.get(), bytes.get() + result.count};
}

} // namespace

void require_module(std::string_view format) {
  if (format == "exr")
    loaded<LayersEncode>(find_openexr_function(openexr_encode_name));
  else if (is_jpeg(format) || format == "hdr")
    find_encoder(format);
}

Bytes encode_with_module(const std::string& format, const Picture& picture) {
  Bytes codes;
  if (is_jpeg(format)) {
    codes.resize(3 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
    put_codes(picture, 0, codes.size(), codes.data());
  }
  PictureToEncode request{};
  request.format = format.c_str();
  request.pixels = is_jpeg(format) ? codes.data() : static_cast<const void*>(picture.linear);
  request.width = picture.width;
  request.height = picture.height;
  return encode(find_encoder(format), request, request.format);
}

Bytes encode_exr(const LayersToEncode& layers) {
  auto* const encoder = loaded<LayersEncode>(find_openexr_function(openexr_encode_name));
  return encode(encoder, layers, "exr");
}

Bytes encode_exr(const Picture& picture) {
  const LayerChannel channels[] = {
      {"R", picture.linear, 3, 0}, {"G", picture.linear + 1, 3, 0}, {"B", picture.linear + 2, 3, 0}};
  return encode_exr({channels, 3, picture.width, picture.height, 0, 0, picture.width, picture.height,
                     thread_count(picture.threads), nullptr});
}

} // namespace fastrt
