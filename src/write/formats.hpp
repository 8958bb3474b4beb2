// SPDX-License-Identifier: Apache-2.0
// The encoders behind encode_image. Each takes 3 * width * height linear values and returns the whole file.
#pragma once

#include <string>
#include <vector>

namespace fastrt {

using Bytes = std::vector<unsigned char>;

struct Picture {
  const float* rgb;
  int width, height;
  int threads;
};

Bytes encode_png(const Picture& picture);
Bytes encode_ppm(const Picture& picture);
Bytes encode_pfm(const Picture& picture);
Bytes encode_tiff(const Picture& picture);
// exr, hdr, jpg and jpeg, by the module that holds OpenImageIO.
Bytes encode_with_module(const std::string& format, const Picture& picture);

} // namespace fastrt
