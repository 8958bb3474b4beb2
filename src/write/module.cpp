// SPDX-License-Identifier: Apache-2.0
// The formats that OpenImageIO writes: finds its module and calls it.
#include "src/write/oiio/module.hpp"

#include "src/scene/printable.hpp"
#include "src/scene/threads.hpp"
#include "src/write/formats.hpp"
#include "src/write/srgb.hpp"

#include <fastrt/error.hpp>

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <memory>

namespace fastrt {

namespace {

namespace fs = std::filesystem;

// The folders to look into, first come first served. FASTRT_MODULE_PATH, if set, is the only one.
std::vector<fs::path> module_folders() {
  if (const char* path = secure_getenv("FASTRT_MODULE_PATH"); path != nullptr && *path != '\0') return {path};
  std::vector<fs::path> folders;
  Dl_info info{};
  std::error_code error;
  fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (dladdr(reinterpret_cast<const void*>(&module_folders), &info) != 0 && info.dli_fname != nullptr) {
    // A shared library that holds this code; the program's own name may be relative to a folder left since.
    const fs::path holder = fs::canonical(info.dli_fname, error);
    if (!error) program = holder;
  }
  fs::path folder = program.parent_path();
  folders.push_back(folder);
  for (int level = 0; level < 5 && !folder.empty(); ++level) {
    folders.push_back(folder / FASTRT_LIBDIR / "fastrt");
    if (!folder.has_relative_path()) break;
    folder = folder.parent_path();
  }
  folders.emplace_back(FASTRT_MODULE_DIR);
  return folders;
}

[[noreturn]] void refuse(const std::string& why) {
  throw OutputError("cannot load the module for this picture format: " + printable(why));
}

OiioEncode* load_module() {
  std::string searched;
  for (const fs::path& folder : module_folders()) {
    const fs::path path = folder / oiio_module_file;
    std::error_code error;
    if (!fs::exists(path, error)) {
      searched += ' ' + folder.string();
      continue;
    }
    // Local and lazy: its 250 libraries neither meet the program's symbols nor get bound before they are
    // used.
    void* module = dlopen(path.c_str(), RTLD_LOCAL | RTLD_LAZY);
    if (module == nullptr) refuse(dlerror());
    void* function = dlsym(module, oiio_encode_name);
    if (function == nullptr) refuse(path.string() + " is of another version");
    return reinterpret_cast<OiioEncode*>(function);
  }
  refuse(std::string(oiio_module_file) + " is in none of" + searched);
}

struct Free {
  void operator()(unsigned char* bytes) const { std::free(bytes); }
};

// libjpeg would end the process.
void check_limits(const std::string& format, const Picture& picture) {
  const bool is_jpeg = format == "jpg" || format == "jpeg";
  if (is_jpeg && (picture.width > 65500 || picture.height > 65500))
    throw OutputError("a JPEG picture has at most 65500 pixels on a side");
}

Bytes encode(const OiioPicture& request) {
  static OiioEncode* const encode_picture = load_module();
  OiioResult result{};
  const bool done = encode_picture(&request, &result) != 0;
  const std::unique_ptr<unsigned char, Free> bytes(result.bytes);
  if (!done)
    throw OutputError(std::string("cannot encode the picture as ") + request.format + ": " +
                      printable(result.error));
  return {bytes.get(), bytes.get() + result.count};
}

} // namespace

Bytes encode_with_module(const std::string& format, const Picture& picture) {
  check_limits(format, picture);
  const bool is_float = format == "exr" || format == "hdr";
  Bytes codes;
  if (!is_float) {
    codes.resize(3 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
    to_srgb8(picture.rgb, codes.size(), codes.data());
  }
  OiioPicture request{};
  request.format = format.c_str();
  request.pixels = is_float ? static_cast<const void*>(picture.rgb) : codes.data();
  request.is_float = is_float ? 1 : 0;
  request.width = picture.width;
  request.height = picture.height;
  request.threads = thread_count(picture.threads);
  request.channels = 3;
  return encode(request);
}

Bytes encode_exr(const Channels& channels) {
  std::vector<const char*> names;
  for (const std::string& name : channels.names) names.push_back(name.c_str());
  OiioPicture request{};
  request.format = "exr";
  request.pixels = channels.values.data();
  request.is_float = 1;
  request.width = channels.width;
  request.height = channels.height;
  request.threads = thread_count(channels.threads);
  request.channels = static_cast<int>(names.size());
  request.channel_names = names.data();
  request.is_integer = channels.is_integer.data();
  return encode(request);
}

} // namespace fastrt
