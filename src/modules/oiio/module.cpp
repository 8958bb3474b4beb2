// SPDX-License-Identifier: Apache-2.0
#include "src/modules/oiio/picture_check.hpp"
#include "src/modules/pictures.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <thread>

namespace {

using fastrt::DecodedPicture;
using fastrt::EncodedPicture;
using fastrt::PictureFile;
using fastrt::PictureToEncode;

template <class Result>
int fail(Result& result, const std::string& why) {
  const std::string text = why.empty() ? std::string("OpenImageIO gives no reason") : why;
  const std::size_t count = std::min(text.size(), sizeof result.error - 1);
  std::memcpy(result.error, text.data(), count);
  result.error[count] = '\0';
  std::replace(result.error, result.error + count, '\n', ' ');
  return 0;
}

// What `act` returns; a failure instead of what it throws.
template <class Result, class Act>
int guarded(Result& result, const Act& act) {
  try {
    return act();
  } catch (const std::bad_alloc&) {
    return fail(result, fastrt::out_of_memory);
  } catch (const std::exception& error) {
    return fail(result, error.what());
  } catch (...) {
    return fail(result, "an unknown failure");
  }
}

// Once: its threads must not change in number while another file is read. The caller reads several at once.
void settle() {
  static const bool settled = [] {
    OIIO::attribute("debug", 0); // it would print
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", 1);
    return true;
  }();
  static_cast<void>(settled);
}

OIIO::ImageSpec spec_of(const PictureToEncode& picture) {
  OIIO::ImageSpec spec(picture.width, picture.height, 3, OIIO::TypeDesc::FLOAT);
  spec.attribute("Software", "fastrt");
  spec.attribute("oiio:ColorSpace", "Linear");
  return spec;
}

int encode(const PictureToEncode& picture, EncodedPicture& result) {
  settle();
  const std::string name = std::string("picture.") + picture.format;
  std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(name);
  if (!output) return fail(result, OIIO::geterror());
  if (output->supports("ioproxy") == 0) return fail(result, "this format can't be written to memory");
  OIIO::Filesystem::IOVecOutput memory;
  if (!output->set_ioproxy(&memory) || !output->open(name, spec_of(picture)))
    return fail(result, output->geterror());
  // close() can succeed after a failed write_image.
  if (!output->write_image(OIIO::TypeDesc::FLOAT, picture.pixels)) return fail(result, output->geterror());
  if (!output->close() || output->has_error()) return fail(result, output->geterror());
  output.reset();

  const std::vector<unsigned char>& bytes = memory.buffer();
  if (bytes.empty()) return fail(result, "nothing was written");
  result.bytes = static_cast<unsigned char*>(std::malloc(bytes.size()));
  if (result.bytes == nullptr) return fail(result, fastrt::out_of_memory);
  std::memcpy(result.bytes, bytes.data(), bytes.size());
  result.count = bytes.size();
  return 1;
}

// "" if a picture like this may be read, else why not: looked at before any memory is taken for it.
std::string fault_of(const OIIO::ImageSpec& spec, bool is_float, const PictureFile& file) {
  const std::string size = std::to_string(spec.width) + " x " + std::to_string(spec.height) + " pixels";
  if (spec.width < 1 || spec.height < 1) return "it has " + size;
  const auto pixels = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
  if (spec.width > file.most_side || spec.height > file.most_side ||
      pixels > file.most_bytes / (is_float ? 4 * sizeof(float) : 4))
    return size + " are too many";
  if (spec.deep) return "deep pictures are not supported";
  if (spec.depth > 1) return "volumes are not supported";
  // OpenImageIO makes room for three colours and lets libtiff write four.
  constexpr int cmyk = 5;
  if (spec.tile_width != 0 && spec.get_int_attribute("tiff:PhotometricInterpretation") == cmyk)
    return "CMYK colours in tiles are not supported";
  if (spec.nchannels < 1 || spec.nchannels > 64)
    return std::to_string(spec.nchannels) + " channels are not supported";
  return {};
}

// One channel is a grey, two are a grey and alpha; what follows the fourth is left out.
template <class T>
void spread_channels(const T* from, int channels, std::size_t pixels, T opaque, T* rgba) {
  for (std::size_t i = 0; i < pixels; ++i, from += channels, rgba += 4) {
    const bool is_grey = channels < 3;
    rgba[0] = from[0];
    rgba[1] = from[is_grey ? 0 : 1];
    rgba[2] = from[is_grey ? 0 : 2];
    rgba[3] = channels == 2 || channels == 4 ? from[channels - 1] : opaque;
  }
}

template <class T>
int read_pixels(OIIO::ImageInput& input, OIIO::TypeDesc type, T opaque, DecodedPicture& texture) {
  const OIIO::ImageSpec& spec = input.spec();
  const int channels = std::min(spec.nchannels, 4);
  const auto pixels = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
  const std::unique_ptr<T[]> read(new T[pixels * static_cast<std::size_t>(channels)]());
  // It can succeed for a TIFF of which nothing could be read.
  if (!input.read_image(0, 0, 0, channels, type, read.get()) || input.has_error()) {
    texture.is_damaged = 1;
    fail(texture, input.geterror());
  }
  T* const rgba = static_cast<T*>(std::malloc(4 * pixels * sizeof(T)));
  if (rgba == nullptr) return fail(texture, fastrt::out_of_memory);
  spread_channels(read.get(), channels, pixels, opaque, rgba);
  texture.rgba = rgba;
  texture.width = spec.width;
  texture.height = spec.height;
  return 1;
}

int decode(const PictureFile& file, DecodedPicture& texture) {
  settle();
  OIIO::geterror(); // forgets what this thread's last file had to say
  const std::string format = file.format;
  const std::string_view refusal =
      fastrt::fault_of_picture(format, {reinterpret_cast<const char*>(file.bytes), file.count});
  if (!refusal.empty()) return fail(texture, std::string(refusal));
  std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(format);
  if (!input) return fail(texture, OIIO::geterror());
  OIIO::Filesystem::IOMemReader memory(const_cast<unsigned char*>(file.bytes), file.count);
  OIIO::ImageSpec wish, spec;
  wish.attribute("oiio:UnassociatedAlpha", 1); // colours as they are, not times alpha
  if (!input->set_ioproxy(&memory) || !input->open("texture." + format, spec, wish))
    return fail(texture, input->geterror());
  texture.is_linear = spec.format.is_floating_point() || format == "openexr" || format == "hdr";
  texture.is_float = texture.is_linear != 0 || spec.format.size() > 1;
  if (const std::string fault = fault_of(spec, texture.is_float != 0, file); !fault.empty())
    return fail(texture, fault);
  if (texture.is_float != 0) return read_pixels<float>(*input, OIIO::TypeDesc::FLOAT, 1.0F, texture);
  return read_pixels<unsigned char>(*input, OIIO::TypeDesc::UINT8, 255, texture);
}

// In a thread of its own: the last words of libtiff are kept for each thread, and may be taken for the reason
// why another file can't be read.
int decode_tiff(const PictureFile& file, DecodedPicture& texture) {
  int done = 0;
  std::thread([&] { done = guarded(texture, [&] { return decode(file, texture); }); }).join();
  return done;
}

} // namespace

extern "C" __attribute__((visibility("default"))) int fastrt_oiio_encode_5(const PictureToEncode* picture,
                                                                           EncodedPicture* result) {
  return guarded(*result, [&] { return encode(*picture, *result); });
}

extern "C" __attribute__((visibility("default"))) int fastrt_oiio_decode_1(const PictureFile* file,
                                                                           DecodedPicture* texture) {
  return guarded(*texture, [&] {
    const bool is_tiff = std::string_view(file->format) == "tiff";
    return is_tiff ? decode_tiff(*file, *texture) : decode(*file, *texture);
  });
}
