// SPDX-License-Identifier: Apache-2.0
#include "src/cli/help.hpp"

#include "src/cli/light_text.hpp"

#include <fastrt/isa.hpp>
#include <fastrt/version.hpp>

#include <algorithm>
#include <cstddef>
#include <span>

namespace fastrt::cli {
namespace {

constexpr const char* examples =
    "Examples:\n"
    "  fastrt bunny.obj                          render bunny.png, 1024x768, one ray a pixel\n"
    "  fastrt bunny.obj -s 16 -r 1920x1080 -o big.exr\n"
    "  fastrt bunny.obj --eye 0,1,4 --look-at 0,0,0 --light point:3,5,2:1,0.9,0.8\n"
    "  fastrt bunny.obj -o none --verify         compare the fast kernels with plain scalar code\n"
    "  fastrt bunny.obj -o none --stats=json     measure\n"
    "\n"
    "Pictures: png ppm jpg tif (8 bits, sRGB) and exr hdr pfm (linear), by the name's extension.\n"
    "AOVs: id primitive material depth normal position uv albedo shadow depth-of-recursion cost; as "
    "channels\n"
    "of an EXR picture, else one SCENE-NAME.png each.\n"
    "Exit codes: 0 done, 1 --verify found a difference, 2 usage, 3 bad scene or camera, 4 output,\n"
    "5 out of memory or over a limit, 128+n ended by signal n.";

constexpr LightForm light_fields[] = {
    {"color", "[:R,G,B]", "its colour; SCALE is one too, or a number"},
    {"fade", "[:fade=C,L,Q]", "divided by C + L d + Q d^2 at distance d; not dir, mesh, emissive"},
    {"ambient", "[:ambient=R,G,B]", "light that it adds everywhere"},
    {"shadows", "[:shadows=off]", "nothing stands in its way"},
};

std::string aligned(std::span<const LightForm> forms) {
  constexpr std::size_t column = 50;
  std::string text;
  for (const LightForm& form : forms) {
    std::string line = std::string("  ") + form.form;
    line.resize(std::max(line.size() + 1, column), ' ');
    text += line + form.help + "\n";
  }
  return text;
}

std::string light_section() {
  return "Lights, of which LIGHT is one:\n" + aligned(light_forms()) + "and then, as wanted:\n" +
         aligned(light_fields);
}

} // namespace

std::string help_footer() { return light_section() + "\n" + examples; }

std::string version_text() {
  std::string text = std::string("fastrt ") + version() + "\ninstruction sets here:";
  for (const Isa isa : available_isas()) text += std::string(" ") + isa_name(isa);
  return text + "\n";
}

} // namespace fastrt::cli
