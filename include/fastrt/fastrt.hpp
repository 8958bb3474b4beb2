// SPDX-License-Identifier: Apache-2.0
// All of fastrt:
//
//   fastrt::Diagnostics diagnostics;
//   fastrt::SceneDesc desc = fastrt::load_scene("bunny.obj", {}, diagnostics);
//   fastrt::Aabb bounds = fastrt::bounds_of(desc);
//   fastrt::Camera camera = fastrt::frame_scene(bounds, 40, 4.0F / 3);
//   fastrt::add_default_lights(desc, bounds, camera);
//   fastrt::Tracer tracer{fastrt::Scene(std::move(desc))};
//   fastrt::Frame frame = fastrt::render(tracer, camera, {});
//   fastrt::write_image("bunny.png", frame.rgb, frame.width, frame.height);
#pragma once

#include <fastrt/aov.hpp>
#include <fastrt/bvh_quality.hpp>
#include <fastrt/camera.hpp>
#include <fastrt/column.hpp>
#include <fastrt/diagnostics.hpp>
#include <fastrt/error.hpp>
#include <fastrt/isa.hpp>
#include <fastrt/light.hpp>
#include <fastrt/load.hpp>
#include <fastrt/material.hpp>
#include <fastrt/math.hpp>
#include <fastrt/picture.hpp>
#include <fastrt/render.hpp>
#include <fastrt/scene.hpp>
#include <fastrt/texture.hpp>
#include <fastrt/tracer.hpp>
#include <fastrt/version.hpp>
#include <fastrt/write.hpp>
