// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace fastrt {

// Throws InputError unless 0 < fov_degrees < 180.
void check_field_of_view(float fov_degrees);

} // namespace fastrt
