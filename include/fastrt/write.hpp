// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace fastrt {

// The extensions that write_image knows, without the dot: png ppm pfm exr jpg jpeg tif tiff hdr.
std::vector<std::string> image_extensions();

// Throws UsageError for an extension that is not known and OutputError if the file could not be written there
// (no such folder, no permission, a folder of that name). Writes nothing that stays.
void check_image_path(const std::filesystem::path& path);

// Writes a picture: rgb holds 3 * width * height linear values, rows from the top. 8-bit formats (png, ppm,
// jpg, tif) get the sRGB curve, clamped to 0..1; exr, hdr and pfm stay linear. The file appears whole or not
// at all: encoded in memory, written beside its place, synced and renamed. Throws OutputError with the
// system's reason. threads: 0 takes every core.
void write_image(const std::filesystem::path& path, std::span<const float> rgb, int width, int height,
                 int threads = 0);

// The same bytes without a file. format: one of image_extensions().
std::vector<unsigned char> encode_image(const std::string& format, std::span<const float> rgb, int width,
                                        int height, int threads = 0);

} // namespace fastrt
