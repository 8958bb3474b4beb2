// SPDX-License-Identifier: Apache-2.0
// Finds the module that holds OpenImageIO and loads it.
#include "src/oiio/open.hpp"

#include "src/oiio/module/module.hpp"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <vector>

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

struct Module {
  void* handle = nullptr;
  std::string path, fault;
};

Module load_module() {
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
    if (module == nullptr) return {nullptr, {}, dlerror()};
    return {module, path.string(), {}};
  }
  return {nullptr, {}, std::string(oiio_module_file) + " is in none of" + searched};
}

} // namespace

OiioFunction find_oiio_function(const char* name) {
  static const Module module = load_module();
  if (module.handle == nullptr) return {nullptr, module.fault};
  void* function = dlsym(module.handle, name);
  if (function == nullptr) return {nullptr, module.path + " is of another version"};
  return {function, {}};
}

} // namespace fastrt
