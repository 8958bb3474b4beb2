// SPDX-License-Identifier: Apache-2.0
// The children of a node that a ray meets, put onto its stack in the order of their distances. Which are met
// can hardly be foreseen, so where eight lanes exist it is done without a branch: those that are met are
// moved together and sorted by a network, four of them or, seldom, eight.
// find_met(node, meet, boxes): which boxes a ray meets; meet(half) gives where it is in them.
// push_in_order(node, boxes, top): writes up to eight entries from `top` on, the nearest on top; returns the
// new top.
#pragma once

#if defined(__AVX512DQ__)
#include "src/kernels/lone_order_avx512.hpp"
#elif defined(__AVX2__)
#include "src/kernels/lone_order_avx2.hpp"
#else
#include "src/kernels/lone_order_sse42.hpp"
#endif
