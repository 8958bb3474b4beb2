// SPDX-License-Identifier: Apache-2.0
#include "src/write/oiio/module.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <string>

namespace {

using fastrt::OiioPicture;
using fastrt::OiioResult;

int fail(OiioResult& result, const std::string& why) {
  const std::string text = why.empty() ? std::string("OpenImageIO gives no reason") : why;
  const std::size_t count = std::min(text.size(), sizeof result.error - 1);
  std::memcpy(result.error, text.data(), count);
  result.error[count] = '\0';
  std::replace(result.error, result.error + count, '\n', ' ');
  return 0;
}

OIIO::ImageSpec spec_of(const OiioPicture& picture) {
  const std::string format = picture.format;
  OIIO::ImageSpec spec(picture.width, picture.height, picture.channels,
                       picture.is_float != 0 ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8);
  for (int c = 0; picture.channel_names != nullptr && c < picture.channels; ++c) {
    spec.channelnames[static_cast<std::size_t>(c)] = picture.channel_names[c];
    spec.channelformats.push_back(picture.is_integer[c] != 0 ? OIIO::TypeDesc::UINT32
                                                             : OIIO::TypeDesc::FLOAT);
  }
  spec.attribute("Software", "fastrt");
  spec.attribute("oiio:ColorSpace", picture.is_float != 0 ? "Linear" : "sRGB");
  if (format == "jpg" || format == "jpeg") {
    spec.attribute("Compression", "jpeg:95");
    spec.attribute("jpeg:subsampling", "4:4:4"); // renders have sharp edges in colour too
  }
  if (format == "exr") spec.attribute("Compression", "zip");
  // Else the EXR writer adds the time, and equal pictures would differ in their bytes. It leaves out a
  // number.
  spec.attribute("DateTime", 0);
  return spec;
}

int encode(const OiioPicture& picture, OiioResult& result) {
  OIIO::attribute("debug", 0); // it would print
  OIIO::attribute("threads", picture.threads);
  OIIO::attribute("exr_threads", picture.threads);
  const std::string name = std::string("picture.") + picture.format;
  std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(name);
  if (!output) return fail(result, OIIO::geterror());
  if (output->supports("ioproxy") == 0) return fail(result, "this format can't be written to memory");
  OIIO::Filesystem::IOVecOutput memory;
  if (!output->set_ioproxy(&memory) || !output->open(name, spec_of(picture)))
    return fail(result, output->geterror());
  const OIIO::TypeDesc type = picture.channel_names != nullptr ? OIIO::TypeDesc::UNKNOWN // as they are
                              : picture.is_float != 0          ? OIIO::TypeDesc::FLOAT
                                                               : OIIO::TypeDesc::UINT8;
  // close() can succeed after a failed write_image.
  if (!output->write_image(type, picture.pixels)) return fail(result, output->geterror());
  if (!output->close() || output->has_error()) return fail(result, output->geterror());
  output.reset();

  const std::vector<unsigned char>& bytes = memory.buffer();
  if (bytes.empty()) return fail(result, "nothing was written");
  result.bytes = static_cast<unsigned char*>(std::malloc(bytes.size()));
  if (result.bytes == nullptr) return fail(result, "out of memory");
  std::memcpy(result.bytes, bytes.data(), bytes.size());
  result.count = bytes.size();
  return 1;
}

} // namespace

extern "C" __attribute__((visibility("default"))) int fastrt_oiio_encode_2(const OiioPicture* picture,
                                                                           OiioResult* result) {
  try {
    return encode(*picture, *result);
  } catch (const std::exception& error) {
    return fail(*result, error.what());
  } catch (...) {
    return fail(*result, "an unknown failure");
  }
}
