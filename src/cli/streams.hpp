// SPDX-License-Identifier: Apache-2.0
// Standard streams that the caller has closed.
#pragma once

namespace fastrt::cli {

// Puts /dev/null in their place: without this, the first file opened would take it. To be called first.
void fill_closed_streams() noexcept;

// Whether standard output was one of them, so that what is written there is lost.
bool standard_output_is_closed() noexcept;

} // namespace fastrt::cli
