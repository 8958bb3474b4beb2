// SPDX-License-Identifier: Apache-2.0
#include "bench/embree_scene.hpp"

#include <fastrt/error.hpp>

#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <chrono>

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

// Field `lane` of a packet's column; a single ray has plain fields.
float& at(float& field, int) { return field; }
unsigned& at(unsigned& field, int) { return field; }
template <class T, int width>
T& at(T (&column)[width], int lane) {
  return column[lane];
}

template <int width>
class EmbreeWorker final : public Worker {
  using RayHit = typename Packet<width>::RayHit;

public:
  EmbreeWorker(RTCScene scene, bool coherent, Question question, std::uint32_t triangle_count)
      : scene_(scene), question_(question), triangle_count_(triangle_count) {
    rtcInitIntersectContext(&context_);
    context_.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  }

  void load(const RayBatch* batches, std::size_t count) override {
    packets_.resize(count * batch_size / width);
    lanes_.clear();
    for (std::size_t b = 0; b < count; ++b) load(batches[b]);
  }

  void trace() override {
    for (std::size_t i = 0; i < lanes_.size(); ++i) {
      const int* const valid = valid_lanes.rows[lanes_[i]];
      if (question_ == Question::any)
        Packet<width>::occluded(valid, scene_, &context_, &packets_[i]);
      else
        Packet<width>::intersect(valid, scene_, &context_, &packets_[i]);
    }
  }

  void answers(std::vector<std::int32_t>& out) const override {
    out.clear();
    for (std::size_t p = 0; p < lanes_.size(); ++p) {
      RayHit packet = packets_[p];
      for (int lane = 0; lane < lanes_[p]; ++lane) out.push_back(answer(packet, lane));
    }
  }

private:
  // Row n has -1 for the first n lanes and 0 for the others.
  struct alignas(64) ValidLanes {
    int rows[width + 1][width];
    constexpr ValidLanes() : rows{} {
      for (int used = 0; used <= width; ++used)
        for (int i = 0; i < used; ++i) rows[used][i] = -1;
    }
  };
  static constexpr ValidLanes valid_lanes{};

  // Packets are full, whatever places the batch leaves empty.
  void load(const RayBatch& batch) {
    int rows[batch_size];
    int rays = 0;
    for (int i = 0; i < batch.count; ++i)
      if (is_ray(batch, i)) rows[rays++] = i;
    for (int first = 0; first < rays; first += width) {
      const int used = std::min(width, rays - first);
      fill(packets_[lanes_.size()], batch, rows + first, used);
      lanes_.push_back(used);
    }
  }

  static void fill(RayHit& packet, const RayBatch& batch, const int* rows, int used) {
    for (int lane = 0; lane < width; ++lane) {
      const int i = rows[std::min(lane, used - 1)];
      at(packet.ray.org_x, lane) = batch.origin_x[i];
      at(packet.ray.org_y, lane) = batch.origin_y[i];
      at(packet.ray.org_z, lane) = batch.origin_z[i];
      at(packet.ray.dir_x, lane) = batch.dir_x[i];
      at(packet.ray.dir_y, lane) = batch.dir_y[i];
      at(packet.ray.dir_z, lane) = batch.dir_z[i];
      at(packet.ray.tnear, lane) = batch.t_min[i];
      at(packet.ray.tfar, lane) = batch.t_max[i];
      at(packet.ray.time, lane) = 0.0F;
      at(packet.ray.mask, lane) = 0xFFFFFFFFU;
      at(packet.ray.id, lane) = 0;
      at(packet.ray.flags, lane) = 0;
      at(packet.hit.geomID, lane) = RTC_INVALID_GEOMETRY_ID;
    }
  }

  std::int32_t answer(RayHit& packet, int lane) const {
    if (question_ == Question::any) return at(packet.ray.tfar, lane) < 0.0F ? 0 : no_primitive;
    const unsigned geometry = at(packet.hit.geomID, lane), primitive = at(packet.hit.primID, lane);
    if (geometry == RTC_INVALID_GEOMETRY_ID) return no_primitive;
    return static_cast<std::int32_t>(geometry == 0 ? primitive : triangle_count_ + primitive);
  }

  RTCScene scene_;
  RTCIntersectContext context_{};
  Question question_;
  std::uint32_t triangle_count_;
  std::vector<RayHit> packets_;
  std::vector<int> lanes_;
};

struct Memory {
  std::atomic<std::ptrdiff_t> held{0}, peak{0};
};

bool count_memory(void* user, ssize_t bytes, bool) {
  Memory& memory = *static_cast<Memory*>(user);
  const std::ptrdiff_t held = memory.held.fetch_add(bytes) + bytes;
  std::ptrdiff_t peak = memory.peak.load();
  while (held > peak && !memory.peak.compare_exchange_weak(peak, held)) {
  }
  return true;
}

void attach_triangles(RTCDevice device, RTCScene target, const Scene& scene) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_MEDIUM);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), scene.positions().size()));
  for (std::size_t i = 0; i < scene.positions().size(); ++i) {
    vertices[3 * i] = scene.positions().x[i];
    vertices[3 * i + 1] = scene.positions().y[i];
    vertices[3 * i + 2] = scene.positions().z[i];
  }
  auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), scene.triangle_count()));
  for (std::size_t i = 0; i < scene.triangle_count(); ++i) {
    indices[3 * i] = scene.triangles().v0[i];
    indices[3 * i + 1] = scene.triangles().v1[i];
    indices[3 * i + 2] = scene.triangles().v2[i];
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(target, geometry, 0);
  rtcReleaseGeometry(geometry);
}

void attach_spheres(RTCDevice device, RTCScene target, const Scene& scene) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_MEDIUM);
  auto* spheres = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), scene.sphere_count()));
  for (std::size_t i = 0; i < scene.sphere_count(); ++i) {
    spheres[4 * i] = scene.spheres().x[i];
    spheres[4 * i + 1] = scene.spheres().y[i];
    spheres[4 * i + 2] = scene.spheres().z[i];
    spheres[4 * i + 3] = scene.spheres().radius[i];
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(target, geometry, 1);
  rtcReleaseGeometry(geometry);
}

class BuiltEmbreeScene final : public EmbreeScene {
public:
  BuiltEmbreeScene(const Scene& scene, bool robust, int threads) : triangle_count_(scene.triangle_count()) {
    device_ = rtcNewDevice(("threads=" + std::to_string(threads)).c_str());
    if (device_ == nullptr) throw Error("Embree offers no device");
    scene_ = rtcNewScene(device_);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_MEDIUM);
    if (robust) rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    if (scene.triangle_count() != 0) attach_triangles(device_, scene_, scene);
    if (scene.sphere_count() != 0) attach_spheres(device_, scene_, scene);
    rtcSetDeviceMemoryMonitorFunction(device_, count_memory, &memory_);
    const auto start = std::chrono::steady_clock::now();
    rtcCommitScene(scene_);
    build_seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    bytes_ = static_cast<std::size_t>(memory_.held.load());
    if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) throw Error("Embree could not build the scene");
  }
  ~BuiltEmbreeScene() override {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  Contender contender(const EmbreeMode& mode) const override {
    return {"embree " + name_of(mode),
            [this, mode](Question question) { return make_worker(mode, question); }};
  }
  double build_seconds() const override { return build_seconds_; }
  std::size_t bytes() const override { return bytes_; }
  std::size_t peak_bytes() const override { return static_cast<std::size_t>(memory_.peak.load()); }

private:
  std::unique_ptr<Worker> make_worker(const EmbreeMode& mode, Question question) const {
    switch (mode.width) {
    case 4:
      return std::make_unique<EmbreeWorker<4>>(scene_, mode.coherent, question, triangle_count_);
    case 8:
      return std::make_unique<EmbreeWorker<8>>(scene_, mode.coherent, question, triangle_count_);
    case 16:
      return std::make_unique<EmbreeWorker<16>>(scene_, mode.coherent, question, triangle_count_);
    default:
      return std::make_unique<EmbreeWorker<1>>(scene_, mode.coherent, question, triangle_count_);
    }
  }

  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
  Memory memory_;
  double build_seconds_ = 0;
  std::size_t bytes_ = 0;
  std::uint32_t triangle_count_;
};

} // namespace

std::vector<EmbreeMode> embree_modes() {
  return {{1, false}, {1, true}, {4, false}, {4, true}, {8, false}, {8, true}, {16, false}, {16, true}};
}

std::string name_of(const EmbreeMode& mode) {
  return std::to_string(mode.width) + (mode.coherent ? " coherent" : "");
}

std::unique_ptr<EmbreeScene> build_embree_scene(const Scene& scene, bool robust, int threads) {
  return std::make_unique<BuiltEmbreeScene>(scene, robust, threads);
}

std::string embree_version() {
  RTCDevice device = rtcNewDevice(nullptr);
  const auto version = static_cast<long>(rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_VERSION));
  rtcReleaseDevice(device);
  return std::to_string(version / 10000) + "." + std::to_string(version / 100 % 100) + "." +
         std::to_string(version % 100);
}

} // namespace fastrt::bench
