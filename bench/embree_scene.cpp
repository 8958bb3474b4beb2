// SPDX-License-Identifier: Apache-2.0
#include "bench/embree_scene.hpp"

#include <fastrt/error.hpp>

#include <embree3/rtcore.h>

#include <array>
#include <atomic>
#include <chrono>
#include <type_traits>

#include "bench/embree_workers.hpp"

namespace fastrt::bench {
namespace {

// In the order of EmbreeCall.
constexpr std::array<const char*, 8> call_names{"1", "4", "8", "16", "1M", "1Mp", "NM", "Np"};

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

struct Release {
  void operator()(RTCDevice device) const noexcept { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const noexcept { rtcReleaseScene(scene); }
};
using DeviceOwner = std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release>;
using SceneOwner = std::unique_ptr<std::remove_pointer_t<RTCScene>, Release>;

DeviceOwner make_device(const EmbreeSettings& settings) {
  std::string text = "threads=" + std::to_string(settings.threads);
  if (settings.isa) text += std::string(",isa=") + isa_name(*settings.isa);
  DeviceOwner device(rtcNewDevice(text.c_str()));
  if (device == nullptr) throw Error("Embree offers no device for " + text);
  return device;
}

class BuiltEmbreeScene final : public EmbreeScene {
public:
  BuiltEmbreeScene(const Scene& scene, const EmbreeSettings& settings)
      : device_(make_device(settings)), scene_(rtcNewScene(device_.get())),
        triangle_count_(scene.triangle_count()) {
    rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_MEDIUM);
    if (settings.robust) rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
    if (scene.triangle_count() != 0) attach_triangles(device_.get(), scene_.get(), scene);
    if (scene.sphere_count() != 0) attach_spheres(device_.get(), scene_.get(), scene);
    rtcSetDeviceMemoryMonitorFunction(device_.get(), count_memory, &memory_);
    const auto start = std::chrono::steady_clock::now();
    rtcCommitScene(scene_.get());
    build_seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    bytes_ = static_cast<std::size_t>(memory_.held.load());
    if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE) throw Error("Embree could not build the scene");
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
    const EmbreeQuery query{scene_.get(), mode.coherent, question, triangle_count_};
    std::unique_ptr<Worker> worker = make_packet_worker(mode.call, query);
    return worker != nullptr ? std::move(worker) : make_stream_worker(mode.call, query);
  }

  Memory memory_; // the device reports to it to the end
  DeviceOwner device_;
  SceneOwner scene_;
  double build_seconds_ = 0;
  std::size_t bytes_ = 0;
  std::uint32_t triangle_count_;
};

} // namespace

std::vector<EmbreeMode> embree_modes() {
  std::vector<EmbreeMode> modes;
  for (std::size_t call = 0; call < call_names.size(); ++call)
    for (const bool coherent : {false, true}) modes.push_back({static_cast<EmbreeCall>(call), coherent});
  return modes;
}

std::vector<EmbreeMode> packet_modes(int width) {
  const EmbreeCall call = width == 4   ? EmbreeCall::packet_4
                          : width == 8 ? EmbreeCall::packet_8
                                       : EmbreeCall::packet_16;
  return {{call, false}, {call, true}};
}

std::string name_of(const EmbreeMode& mode) {
  return call_names[static_cast<std::size_t>(mode.call)] + std::string(mode.coherent ? " coherent" : "");
}

std::unique_ptr<EmbreeScene> build_embree_scene(const Scene& scene, const EmbreeSettings& settings) {
  return std::make_unique<BuiltEmbreeScene>(scene, settings);
}

std::string embree_version() {
  const DeviceOwner device = make_device({});
  const auto version = static_cast<long>(rtcGetDeviceProperty(device.get(), RTC_DEVICE_PROPERTY_VERSION));
  return std::to_string(version / 10000) + "." + std::to_string(version / 100 % 100) + "." +
         std::to_string(version % 100);
}

} // namespace fastrt::bench
