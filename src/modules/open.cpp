// SPDX-License-Identifier: Apache-2.0
// Finds modules and loads them.
#include "src/modules/open.hpp"

#include "src/modules/pictures.hpp"

#include <dlfcn.h>
#include <link.h>

#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <vector>

// Of an installed library, by the program that uses it (cmake/module_folder.cpp).
extern "C" __attribute__((weak)) const char fastrt_module_folder[];

namespace fastrt {

namespace {

namespace fs = std::filesystem;

// The file that holds this code: a shared library or the program. What the program was called, which is all
// that dladdr knows of it, may name something else in the current folder; the loader gives it no name.
fs::path holder() {
  std::error_code error;
  Dl_info info{};
  void* map = nullptr;
  if (dladdr1(reinterpret_cast<const void*>(&holder), &info, &map, RTLD_DL_LINKMAP) != 0 && map != nullptr) {
    const std::string_view library = static_cast<const link_map*>(map)->l_name;
    if (const fs::path file = fs::canonical(library, error); !library.empty() && !error) return file;
  }
  return fs::read_symlink("/proc/self/exe", error);
}

// The folders to look into, first come first served. FASTRT_MODULE_PATH, if set, is the only one.
std::vector<fs::path> module_folders() {
  if (const char* path = secure_getenv("FASTRT_MODULE_PATH"); path != nullptr && *path != '\0') return {path};
  std::vector<fs::path> folders;
  fs::path folder = holder().parent_path();
  if (!folder.empty()) folders.push_back(folder);
  for (int level = 0; level < 5 && !folder.empty(); ++level) {
    folders.push_back(folder / FASTRT_LIBDIR / "fastrt");
    if (!folder.has_relative_path()) break;
    folder = folder.parent_path();
  }
  if (const char* installed = fastrt_module_folder; installed != nullptr) folders.emplace_back(installed);
  folders.emplace_back(FASTRT_MODULE_DIR);
  return folders;
}

struct Module {
  void* handle = nullptr;
  std::string path, fault;
};

Module load_module(const char* file) {
  std::string searched;
  for (const fs::path& folder : module_folders()) {
    const fs::path path = folder / file;
    std::error_code error;
    if (!fs::exists(path, error)) {
      searched += ' ' + folder.string();
      continue;
    }
    // Local and lazy: OpenImageIO's 250 libraries neither meet the program's symbols nor get bound before
    // they are used.
    void* module = dlopen(path.c_str(), RTLD_LOCAL | RTLD_LAZY);
    if (module == nullptr) return {nullptr, {}, dlerror()};
    return {module, path.string(), {}};
  }
  return {nullptr, {}, std::string(file) + " is in none of" + searched};
}

ModuleFunction find_function(const Module& module, const char* name) {
  if (module.handle == nullptr) return {nullptr, module.fault};
  void* function = dlsym(module.handle, name);
  if (function == nullptr) return {nullptr, module.path + " is of another version"};
  return {function, {}};
}

} // namespace

ModuleFunction find_oiio_function(const char* name) {
  static const Module module = load_module(oiio_module_file);
  return find_function(module, name);
}

ModuleFunction find_png_jpeg_function(const char* name) {
  static const Module module = load_module(png_jpeg_module_file);
  return find_function(module, name);
}

ModuleFunction find_openexr_function(const char* name) {
  static const Module module = load_module(openexr_module_file);
  return find_function(module, name);
}

} // namespace fastrt
