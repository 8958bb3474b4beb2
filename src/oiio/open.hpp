// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace fastrt {

// A function of the module that holds OpenImageIO, or null and why there is none.
struct OiioFunction {
  void* function = nullptr;
  std::string fault;
};

// Loads the module when it is first asked for. It stays loaded. May be called from several threads at once.
OiioFunction find_oiio_function(const char* name);

} // namespace fastrt
