// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace fastrt {

// A function of a module, or null and why there is none.
struct ModuleFunction {
  void* function = nullptr;
  std::string fault;
};

// Each loads its module when it is first asked for; it stays loaded. May be called from several threads at
// once.
ModuleFunction find_oiio_function(const char* name);
ModuleFunction find_png_jpeg_function(const char* name);
ModuleFunction find_openexr_function(const char* name);

} // namespace fastrt
