// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace fastrt {

// "0.1.0"
const char* version() noexcept;

} // namespace fastrt
