// SPDX-License-Identifier: Apache-2.0
// Lights as the command line writes them: parts between colons. All throw UsageError, whose text begins with
// the option's name and says which part is wrong.
#pragma once

#include <fastrt/light.hpp>

#include <span>
#include <string>
#include <string_view>

namespace fastrt::cli {

// A kind of light, or a field: its name, how it is written, and what it is.
struct LightForm {
  const char *name, *form, *help;
};
// Of the kinds.
std::span<const LightForm> light_forms();

// The parts of a text.
class ColonParts {
public:
  explicit ColonParts(std::string_view text) : text_(text) {}

  bool done() const { return done_; }
  // Empty when there is none left.
  std::string_view next();
  // What is left.
  std::string_view rest() const { return text_; }

private:
  std::string_view text_;
  bool done_ = false;
};

// A light with a place or a direction of its own, in one of these forms:
//   point:x,y,z   dir:x,y,z (the way that it travels)   spot:x,y,z:dx,dy,dz:cone[,penumbra[,exponent]]
//   rect:x,y,z:ux,uy,uz:vx,vy,vz (half sides)   disk:x,y,z:nx,ny,nz:radius   sphere:x,y,z:radius
// and then the fields that read_light_fields reads.
Light parse_light(std::string_view option, std::string_view text);

// [r,g,b], or of meshes a number too, and then in any order:
//   fade=constant,linear,quadratic   ambient=r,g,b   shadows=on|off
void read_light_fields(std::string_view option, ColonParts parts, Light& light);

// `kind` is the name of none, or lacks a part that is called `missing`.
[[noreturn]] void refuse_light_kind(std::string_view option, std::string_view kind);
[[noreturn]] void refuse_lack(std::string_view option, std::string_view kind, const std::string& missing);

} // namespace fastrt::cli
