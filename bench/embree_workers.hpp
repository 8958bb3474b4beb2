// SPDX-License-Identifier: Apache-2.0
// The hands of Embree: those that take packets, and those that take whole batches as streams.
#pragma once

#include <embree3/rtcore.h>

#include <cstdint>
#include <memory>

#include "bench/embree_scene.hpp"

namespace fastrt::bench {

// Whom a worker asks and what. Primitives of geometry 1 (spheres) count on after those of geometry 0.
struct EmbreeQuery {
  RTCScene scene; // must outlive the worker
  bool coherent;  // the context's flag
  Question question;
  std::uint32_t triangle_count;
};

// Each takes the calls that are its own, and is null for the others.
std::unique_ptr<Worker> make_packet_worker(EmbreeCall call, const EmbreeQuery& query);
std::unique_ptr<Worker> make_stream_worker(EmbreeCall call, const EmbreeQuery& query);

} // namespace fastrt::bench
