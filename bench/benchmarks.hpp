// SPDX-License-Identifier: Apache-2.0
// The parts of fastrt_bench; each registers its benchmarks, one per ISA that runs here where that matters.
#pragma once

namespace fastrt::bench {

void register_kernels();   // slab, triangle and sphere tests, pow, exp
void register_build();     // the tree
void register_traversal(); // kinds of rays; Embree beside it where it is installed
void register_files();     // OBJ in, PNG out
void register_frames();    // whole pictures

} // namespace fastrt::bench
