#include "pov/object_look.hpp"

#include <algorithm>
#include <glm/common.hpp>

#include "pov/leaf_optics.hpp"
#include "pov/text.hpp"
#include "sim/core/errors.hpp"

namespace witherfield::pov {
namespace {

std::string grain_text(const ObjectLook& look, const std::string& pigment) {
  Text t;
  t << "texture{pigment{" << pigment << "} normal{wrinkles " << 0.35 * look.relief
    << " scale <0.25,5,0.25>} finish{diffuse 1 specular " << 0.12 * look.gloss << " roughness 0.06}}\n";
  return t.str();
}

std::string waxy_text(const ObjectLook& look, const std::string& pigment) {
  Text t;
  t << "texture{pigment{" << pigment << "} normal{bumps " << 0.05 * look.relief << " scale 1.5} finish{diffuse 1 specular "
    << 0.2 * look.gloss << " roughness 0.02 reflection{0," << std::min(1.0, 0.8 * look.gloss)
    << " fresnel on} conserve_energy #if(SSS) subsurface{translucency <0.8,0.5,0.2>*" << look.softness
    << "} #end}} interior{ior 1.45}\n";
  return t.str();
}

std::string leaf_text(const ObjectLook& look, const Pigments& p) {
  // Two layers, each half of what is seen: light sent back, light let through.
  const auto side = [&](const std::string& reflected, double gloss, double rough) {
    return (Text() << "{pigment{" << reflected << "} normal{bumps " << 0.25 * look.relief
                   << " scale 0.8} finish{diffuse 2,0 specular " << 2 * gloss * look.gloss << " roughness " << rough << "}}\n")
        .str();
  };
  const std::string through =
      "{pigment{" + p.through + "} finish{diffuse 0,2}}\n";
  Text t;
  t << "texture" << side(p.front, 0.10, 0.03) << "texture" << through << "interior_texture" << side(p.back, 0.03, 0.1)
    << "interior_texture" << through;
  return t.str();
}

}  // namespace

VertexColours vertex_colours(const Surface& s, bool thin) {
  const SurfaceField& field = s.field("diffuse");
  if (field.on_faces) throw InvalidInput("field 'diffuse' must lie on vertices, lies on faces");
  VertexColours c;
  const std::size_t n = s.position_m.size();
  for (std::size_t i = 0; i < n; ++i)
    c.front.push_back({field.values[3 * i], field.values[3 * i + 1], field.values[3 * i + 2]});
  if (!thin) return c;
  const SurfaceField* green = s.has_field("chlorophyll_ug_cm2") ? &s.field("chlorophyll_ug_cm2") : nullptr;
  for (std::size_t i = 0; i < n; ++i) {
    const glm::vec3 front = c.front[i];
    const double fresh = green ? green->values[i] / kFreshChlorophyll : 1.0;
    const LeafOptics optics = leaf_optics(front, fresh);
    c.through.push_back(glm::min(optics.transmittance, glm::vec3(0.95f) - front));
    // Spongy tissue with air in it lies on the lower side: paler and greyer.
    c.back.push_back(glm::mix(front, glm::vec3(0.42f, 0.47f, 0.36f), 0.22f));
  }
  return c;
}

std::string look_text(const ObjectLook& look, const Pigments& p) {
  switch (look.kind) {
    case LookKind::grain:
      return grain_text(look, p.front);
    case LookKind::waxy:
      return waxy_text(look, p.front);
    case LookKind::leaf:
      return leaf_text(look, p);
    case LookKind::matte:
      break;
  }
  return "texture{pigment{" + p.front + "} finish{diffuse 1}}\n";
}

}  // namespace witherfield::pov
