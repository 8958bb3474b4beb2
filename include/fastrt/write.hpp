// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastrt/render.hpp>

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace fastrt {

// The extensions that write_image knows, without the dot: png ppm pfm exr jpg jpeg tif tiff hdr.
std::vector<std::string> image_extensions();

// Throws UsageError for an extension that is not known and OutputError if the file could not be written there
// (no such folder, no permission, a folder of that name) or the module of its format can't be loaded. Writes
// nothing that stays.
void check_image_path(const std::filesystem::path& path);

// Throws OutputError for a picture that a format can't hold: a JPEG has at most 65500 pixels on a side, a
// TIFF 1400 million in all. format: one of image_extensions().
void check_picture_size(const std::string& format, int width, int height);

// Writes a picture: rgb holds 3 * width * height linear values, rows from the top. 8-bit formats (png, ppm,
// jpg, tif) get the sRGB curve, clamped to 0..1; exr, hdr and pfm stay linear. The file appears whole or not
// at all: encoded in memory, written beside its place, synced and renamed. Throws OutputError with the
// system's reason, and UsageError for an unknown extension or another number of values. threads: as
// RenderSettings::threads.
void write_image(const std::filesystem::path& path, std::span<const float> rgb, int width, int height,
                 int threads = 0);

// The same bytes without a file. format: one of image_extensions(). Throws as write_image does.
std::vector<unsigned char> encode_image(const std::string& format, std::span<const float> rgb, int width,
                                        int height, int threads = 0);

// Whether a format holds 8-bit sRGB codes (png ppm jpg jpeg tif tiff); false for any other word.
bool is_8bit_format(const std::string& format);

// Of such a format, from the codes themselves (Frame::srgb8): the same bytes as from the linear values that
// they were made of. Throws UsageError for other formats.
std::vector<unsigned char> encode_image(const std::string& format, std::span<const unsigned char> srgb8,
                                        int width, int height, int threads = 0);

// The picture and its AOVs as one EXR of 32-bit channels: R G B, then "depth", "normal.X" and so on
// (aov_info). Ids are unsigned integers counted from 1: 0 is the background.
// The file's attribute "fastrt:objects" has a line for each of `objects` (SceneDesc::object_names), in the
// order of their ids. A crop's data window is where it lies, its display window the whole picture. Throws
// UsageError for a frame without a linear picture (PixelFormat::srgb8) and OutputError. threads: as of
// write_image, here and below.
std::vector<unsigned char> encode_layers(const Frame& frame, std::span<const std::string> objects = {},
                                         int threads = 0);

// One of the frame's AOVs as a picture of sRGB codes, three a pixel, to be looked at or read back: ids are
// red + 256 * green + 65536 * blue, counted from 1; normals are n / 2 + 1 / 2; depth is bright where it is
// near, by 1 / depth; like it, position, cost and depth-of-recursion are scaled to their own range, of
// positions without those that lie far from most others.
std::vector<unsigned char> aov_picture(const AovPlane& plane, int threads = 0);

// Every object in its signature_color(), the background black; sRGB codes. `ids`: of Aov::id.
std::vector<unsigned char> signature_picture(const AovPlane& ids, int threads = 0);

} // namespace fastrt
