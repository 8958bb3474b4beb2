// SPDX-License-Identifier: Apache-2.0
#include <fastrt/version.hpp>

namespace fastrt {

const char* version() noexcept { return "0.1.0"; }

} // namespace fastrt
