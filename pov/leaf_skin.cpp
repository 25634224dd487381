#include "pov/leaf_skin.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "pov/leaf_optics.hpp"
#include "pov/relief.hpp"
#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"

namespace witherfield::pov {
namespace {

constexpr int kMostTexels = 4096;
constexpr float kTexelsPerPixel = 1.15f;
// Heights of the relief, metres (estimates from photographs of cucumber leaves: veins sink into the quilted
// upper side and stand out from the lower one).
constexpr float kCushion_m = 0.26e-3f, kGroove_m = 0.30e-3f, kRidge_m = 0.75e-3f;

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

glm::vec2 uv_of(const LitMesh& m, int vertex) {
  return m.vertices[at(vertex)].uv;
}

float cross2(const glm::vec2& a, const glm::vec2& b) {
  return a.x * b.y - a.y * b.x;
}

/// Which face covers a texel's middle, -1: none. Row 0 is v = 0.
std::vector<int> covered(const LitMesh& m, std::span<const int> faces, int n) {
  std::vector<int> face(at(n) * at(n), -1);
  for (const int f : faces) {
    const auto& t = m.triangles[at(f)];
    const glm::vec2 a = uv_of(m, t[0]) * float(n) - 0.5f, b = uv_of(m, t[1]) * float(n) - 0.5f,
                    c = uv_of(m, t[2]) * float(n) - 0.5f;
    const float area = cross2(b - a, c - a);
    if (area == 0) continue;
    const glm::vec2 low = glm::min(glm::min(a, b), c), high = glm::max(glm::max(a, b), c);
    for (int j = std::max(0, int(std::ceil(low.y))); j <= std::min(n - 1, int(high.y)); ++j)
      for (int i = std::max(0, int(std::ceil(low.x))); i <= std::min(n - 1, int(high.x)); ++i) {
        const glm::vec2 p(i, j);
        const float u = cross2(p - a, c - a) / area, v = cross2(b - a, p - a) / area;
        if (u >= 0 && v >= 0 && u + v <= 1) face[at(j) * at(n) + at(i)] = f;
      }
  }
  return face;
}

/// Numbers of the vertices and their shares at a place of a face.
struct Blend {
  std::size_t v[3];
  float share[3];
  template <class Values, class Get>
  auto of(const Values& values, const Get& get) const {
    return share[0] * get(values[v[0]]) + share[1] * get(values[v[1]]) + share[2] * get(values[v[2]]);
  }
  template <class Values>
  auto of(const Values& values) const {
    return share[0] * values[v[0]] + share[1] * values[v[1]] + share[2] * values[v[2]];
  }
};

/// The lobe of a microfacet surface (GGX, Walter et al. 2007, with Schlick's Fresnel term for a cuticle of
/// index 1.45 and the height-correlated Smith term in Karis's form) times cos(light).
float lobe(const glm::vec3& n, const glm::vec3& to_eye, const glm::vec3& to_light, float roughness) {
  const float nl = glm::dot(n, to_light), nv = std::max(glm::dot(n, to_eye), 0.05f);
  if (nl <= 0) return 0;
  const glm::vec3 h = glm::normalize(to_eye + to_light);
  const float nh = std::max(glm::dot(n, h), 0.0f), a = roughness * roughness, a2 = a * a;
  const float d = nh * nh * (a2 - 1) + 1, peak = a2 / (std::numbers::pi_v<float> * d * d);
  const float fresnel = 0.034f + 0.966f * std::pow(1 - std::max(glm::dot(to_eye, h), 0.0f), 5.0f);
  const float smith = 0.5f / glm::mix(2 * nl * nv, nl + nv, a);
  return peak * fresnel * smith * nl;
}

class Painter {
 public:
  Painter(const Studio& s, const View& view, const LitMesh& m, const Glow& glow, const ObjectLook& look,
          double scale, int n)
      : studio_(s),
        eye_(view.position()),
        mesh_(m),
        glow_(glow),
        look_(look),
        scale_(float(scale)),
        n_(n),
        detail_(look.detail(n)) {
    if (detail_.pixels != n || detail_.vein.size() != at(n) * at(n) ||
        detail_.height.size() != detail_.vein.size())
      throw InvalidInput("leaf skin: detail of " + std::to_string(n) + " pixels was asked for, got " +
                         std::to_string(detail_.pixels));
    for (const Softbox& b : s.boxes) {
      const float half = float(0.5 * glm::length(b.side_a_m) / glm::length(b.center_m - s.center_m));
      spread_.push_back(0.25f * std::atan(half));
    }
  }

  /// Both sides at the middle of texel i, j, which lies on face f.
  void paint(int i, int j, int f, glm::vec3& front, glm::vec3& back) const {
    const auto& t = mesh_.triangles[at(f)];
    const glm::vec2 a = uv_of(mesh_, t[0]), ab = uv_of(mesh_, t[1]) - a, ac = uv_of(mesh_, t[2]) - a;
    const glm::vec2 p = (glm::vec2(i, j) + 0.5f) / float(n_) - a;
    const float area = cross2(ab, ac), u = cross2(p, ac) / area, v = cross2(ab, p) / area;
    const Blend b{{at(t[0]), at(t[1]), at(t[2])}, {1 - u - v, u, v}};
    const auto& x = mesh_.vertices;
    const glm::vec3 e1 = x[b.v[1]].position_m - x[b.v[0]].position_m,
                    e2 = x[b.v[2]].position_m - x[b.v[0]].position_m;
    // Metres in space along u and v.
    const glm::vec3 along_u = (e1 * ac.y - e2 * ab.y) / area, along_v = (e2 * ab.x - e1 * ac.x) / area;
    const glm::vec3 n = glm::normalize(b.of(x, [](const LitVertex& w) { return w.normal; }));
    const glm::vec3 at_m = b.of(x, [](const LitVertex& w) { return w.position_m; });
    const glm::vec3 local = b.of(x, [](const LitVertex& w) { return w.local_m; });

    const float vein = detail_.vein[index(i, j)];
    const auto lean = [&](float groove) {
      const float step = float(n_) / 2, relief = float(look_.relief) * scale_;
      const auto h = [&](int k, int l) {
        const std::size_t w = index(std::clamp(k, 0, n_ - 1), std::clamp(l, 0, n_ - 1));
        return kCushion_m * detail_.height[w] - groove * detail_.vein[w];
      };
      const glm::vec3 slope = (h(i + 1, j) - h(i - 1, j)) * step / glm::dot(along_u, along_u) * along_u +
                              (h(i, j + 1) - h(i, j - 1)) * step / glm::dot(along_v, along_v) * along_v;
      return glm::normalize(n - relief * (slope - n * glm::dot(n, slope)) + grain(local));
    };
    const glm::vec3 up = lean(kGroove_m), down = -lean(kRidge_m);
    const Tissue tissue = tissue_at(b, local, vein, detail_.height[index(i, j)]);
    const glm::vec3 above = light(b, glow_.above, up, n), below = light(b, glow_.below, down, -n);
    const float sheen = float(look_.gloss) * (1 - 0.35f * std::min(1.0f, 1.5f * vein));
    front = tissue.front * above * tissue.open + tissue.through * below +
            mirrored(b, glow_.above, at_m, up, 0.52f, sheen);
    back = tissue.back * below + tissue.through * above +
           mirrored(b, glow_.below, at_m, down, 0.68f, 0.55f * sheen);
  }

 private:
  struct Tissue {
    glm::vec3 front, back, through;
    float open;  ///< share of the light that reaches the bottom of a groove
  };

  std::size_t index(int i, int j) const { return at(j) * at(n_) + at(i); }

  /// Cells and hairs' bases: what a matte cuticle scatters.
  glm::vec3 grain(const glm::vec3& local) const {
    glm::vec3 fine, g;
    bumps(local / 0.9e-3f, g);
    bumps(local / 0.35e-3f + 7.0f, fine);
    return float(look_.relief) * (0.050f * g + 0.035f * fine);
  }

  Tissue tissue_at(const Blend& b, const glm::vec3& local, float vein, float height) const {
    const auto& x = mesh_.vertices;
    glm::vec3 unused;
    const float mottle =
        1 + 0.07f * bumps(local / 11e-3f, unused) + 0.045f * bumps(local / 2.3e-3f + 3.0f, unused);
    const glm::vec3 blade = glm::min(b.of(x, [](const LitVertex& w) { return w.front; }) * mottle, 0.9f);
    const glm::vec3 through = b.of(x, [](const LitVertex& w) { return w.through; });
    const glm::vec3 lower = b.of(x, [](const LitVertex& w) { return w.back; });
    // Strength of a vein: 1 main, 0.65 side, 0.26 net (their middles). Fine veins lie between green cells.
    const float thick = glm::smoothstep(0.30f, 0.85f, vein), pale = glm::smoothstep(0.0f, 0.75f, vein);
    Tissue t;
    t.front = glm::mix(blade, look_.vein_rgb, 0.72f * pale);
    t.back = glm::mix(lower * mottle, glm::mix(look_.vein_rgb, glm::vec3(0.50f, 0.56f, 0.40f), 0.35f),
                      0.80f * pale);
    // A fine vein has less to absorb than the green around it; a thick one is a rod of tissue that scatters.
    const glm::vec3 clear = glm::min(glm::pow(glm::max(through, 1e-4f), glm::vec3(0.72f)), 0.55f);
    t.through = glm::mix(glm::mix(through, clear, std::min(1.0f, 2.6f * vein)), 0.45f * clear, thick);
    t.through *= 1 + 0.10f * (height - 0.5f);
    t.open = 1 - 0.22f * float(look_.relief) * (1 - height) * (1 - 0.5f * thick);
    const glm::vec3 most = glm::max(glm::vec3(0.0f), 0.95f - glm::max(t.front, t.back));
    t.through = glm::min(t.through, most);
    return t;
  }

  static glm::vec3 light(const Blend& b, const SideLight& s, const glm::vec3& leaned, const glm::vec3& n) {
    const glm::vec3 d = leaned - n;
    glm::vec3 sum(0.0f);
    for (int k = 0; k < 3; ++k) sum += b.share[k] * s.at(b.v[k], d);
    return glm::max(sum, 0.12f * b.of(s.irradiance));
  }

  glm::vec3 mirrored(const Blend& b, const SideLight& s, const glm::vec3& at_m, const glm::vec3& n,
                     float roughness, float sheen) const {
    const glm::vec3 to_eye = glm::normalize(eye_ - at_m);
    if (sheen <= 0 || glm::dot(to_eye, n) < -0.2f) return glm::vec3(0.0f);
    const glm::vec2 arriving = b.of(s.boxes);
    glm::vec3 sum(0.0f);
    for (std::size_t k = 0; k < std::min<std::size_t>(2, studio_.boxes.size()); ++k) {
      const glm::vec3 to_box = glm::normalize(glm::vec3(studio_.boxes[k].center_m) - at_m);
      sum += glm::vec3(studio_.boxes[k].colour) * arriving[int(k)] * std::numbers::pi_v<float> *
             lobe(n, to_eye, to_box, std::min(0.95f, roughness + spread_[k]));
    }
    // The room in a rough mirror: Fresnel's term for rough surfaces (Lagarde's) on what comes from about
    // there.
    const float nv = std::max(glm::dot(n, to_eye), 0.0f);
    const float fresnel = 0.034f + (std::max(1 - roughness, 0.034f) - 0.034f) * std::pow(1 - nv, 5.0f);
    const glm::vec3 r = 2 * glm::dot(n, to_eye) * n - to_eye,
                    toward = glm::normalize(glm::mix(r, n, roughness));
    sum += 0.55f * fresnel * glm::vec3(studio_.room(glm::dvec3(toward)));
    return sheen * sum;
  }

  const Studio& studio_;
  const glm::vec3 eye_;
  const LitMesh& mesh_;
  const Glow& glow_;
  const ObjectLook& look_;
  const float scale_;
  const int n_;
  const LeafDetail detail_;
  std::vector<float> spread_;
};

/// Texels beside the leaf take the mean of their painted neighbours, so that interpolation at the margin does
/// not meet black.
void bleed_outwards(std::vector<glm::vec3>& rgb, std::vector<char> painted, int n) {
  for (int round = 0; round < 3; ++round) {
    std::vector<char> next = painted;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        if (painted[at(j) * at(n) + at(i)]) continue;
        glm::vec3 sum(0.0f);
        int count = 0;
        for (int l = std::max(0, j - 1); l <= std::min(n - 1, j + 1); ++l)
          for (int k = std::max(0, i - 1); k <= std::min(n - 1, i + 1); ++k)
            if (painted[at(l) * at(n) + at(k)]) sum += rgb[at(l) * at(n) + at(k)], ++count;
        if (count == 0) continue;
        rgb[at(j) * at(n) + at(i)] = sum / float(count);
        next[at(j) * at(n) + at(i)] = 1;
      }
    painted = std::move(next);
  }
}

}  // namespace

int skin_pixels(const LitMesh& m, const View& view) {
  double space = 0, plane = 0, pixel = 0, weight = 0;
  for (const auto& t : m.triangles) {
    const LitVertex &a = m.vertices[at(t[0])], &b = m.vertices[at(t[1])], &c = m.vertices[at(t[2])];
    const double own = std::abs(cross2(b.uv - a.uv, c.uv - a.uv));
    space +=
        own > 0 ? glm::length(glm::cross(b.position_m - a.position_m, c.position_m - a.position_m)) : 0.0;
    plane += own;
    pixel += own * view.pixel_m(a.position_m);
    weight += own;
  }
  if (!(plane > 0)) return 64;
  const double side_m = std::sqrt(space / plane), texel_m = pixel / weight / kTexelsPerPixel;
  return std::clamp(int(std::ceil(side_m / texel_m)), 64, kMostTexels);
}

SkinPictures paint_skin(const Studio& studio, const View& view, const LitMesh& mesh,
                        std::span<const int> faces, const Glow& glow, const ObjectLook& look, double scale) {
  SkinPictures out;
  const int n = out.pixels = skin_pixels(mesh, view);
  const Painter painter(studio, view, mesh, glow, look, scale, n);
  const std::vector<int> face = covered(mesh, faces, n);
  std::vector<char> painted(face.size(), 0);
  out.front.assign(face.size(), glm::vec3(0.0f));
  out.back = out.front;
  parallel_for(at(n), 8, [&](std::size_t begin, std::size_t end) {
    for (int j = int(begin); j < int(end); ++j)
      for (int i = 0; i < n; ++i) {
        const int f = face[at(j) * at(n) + at(i)];
        if (f < 0) continue;
        const std::size_t to = at(n - 1 - j) * at(n) + at(i);
        painter.paint(i, j, f, out.front[to], out.back[to]);
        painted[to] = 1;
      }
  });
  bleed_outwards(out.front, painted, n);
  bleed_outwards(out.back, std::move(painted), n);
  return out;
}

}  // namespace witherfield::pov
