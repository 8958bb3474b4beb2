// SPDX-License-Identifier: Apache-2.0
#include "bench/embree_rays.hpp"

namespace fastrt::bench {
namespace {

// The types and calls of one packet width.
template <int width>
struct Packet;
template <>
struct Packet<1> {
  using RayHit = RTCRayHit;
  static void intersect(const int*, RTCScene s, RTCIntersectContext* c, RayHit* r) { rtcIntersect1(s, c, r); }
  static void occluded(const int*, RTCScene s, RTCIntersectContext* c, RayHit* r) {
    rtcOccluded1(s, c, &r->ray);
  }
};
template <>
struct Packet<4> {
  using RayHit = RTCRayHit4;
  static void intersect(const int* v, RTCScene s, RTCIntersectContext* c, RayHit* r) {
    rtcIntersect4(v, s, c, r);
  }
  static void occluded(const int* v, RTCScene s, RTCIntersectContext* c, RayHit* r) {
    rtcOccluded4(v, s, c, &r->ray);
  }
};
template <>
struct Packet<8> {
  using RayHit = RTCRayHit8;
  static void intersect(const int* v, RTCScene s, RTCIntersectContext* c, RayHit* r) {
    rtcIntersect8(v, s, c, r);
  }
  static void occluded(const int* v, RTCScene s, RTCIntersectContext* c, RayHit* r) {
    rtcOccluded8(v, s, c, &r->ray);
  }
};
template <>
struct Packet<16> {
  using RayHit = RTCRayHit16;
  static void intersect(const int* v, RTCScene s, RTCIntersectContext* c, RayHit* r) {
    rtcIntersect16(v, s, c, r);
  }
  static void occluded(const int* v, RTCScene s, RTCIntersectContext* c, RayHit* r) {
    rtcOccluded16(v, s, c, &r->ray);
  }
};

// Row n has -1 for the first n lanes and 0 for the others.
template <int width>
struct alignas(64) ValidLanes {
  int rows[width + 1][width];
  constexpr ValidLanes() : rows{} {
    for (int used = 0; used <= width; ++used)
      for (int i = 0; i < used; ++i) rows[used][i] = -1;
  }
};
template <int width>
constexpr ValidLanes<width> valid_lanes{};

template <int width>
class PacketWorker final : public EmbreeWorker<typename Packet<width>::RayHit, width> {
public:
  using EmbreeWorker<typename Packet<width>::RayHit, width>::EmbreeWorker;

private:
  void intersect() override {
    for (std::size_t i = 0; i < this->lanes_.size(); ++i)
      Packet<width>::intersect(valid_lanes<width>.rows[this->lanes_[i]], this->scene_, &this->context_,
                               &this->packets_[i]);
  }
  void occlude() override {
    for (std::size_t i = 0; i < this->lanes_.size(); ++i)
      Packet<width>::occluded(valid_lanes<width>.rows[this->lanes_[i]], this->scene_, &this->context_,
                              &this->packets_[i]);
  }
};

} // namespace

std::unique_ptr<Worker> make_packet_worker(EmbreeCall call, const EmbreeQuery& query) {
  switch (call) {
  case EmbreeCall::packet_1:
    return std::make_unique<PacketWorker<1>>(query);
  case EmbreeCall::packet_4:
    return std::make_unique<PacketWorker<4>>(query);
  case EmbreeCall::packet_8:
    return std::make_unique<PacketWorker<8>>(query);
  case EmbreeCall::packet_16:
    return std::make_unique<PacketWorker<16>>(query);
  default:
    return nullptr;
  }
}

} // namespace fastrt::bench
