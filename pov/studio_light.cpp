#include "pov/studio_light.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "pov/bvh.hpp"
#include "sim/core/parallel.hpp"

namespace witherfield::pov {
namespace {

constexpr double kReach = 5;     // softboxes stand this many radii away
constexpr int kBoxPoints = 48;   // of which the first ones tell whether the others are needed
constexpr int kProbes = 10, kCoarsePoints = 6;
constexpr int kDirections = 128, kCoarseDirections = 32;  // over the whole sphere: half of them are above a point
constexpr int kBounces = 3;

/// Points of a sequence that fill the unit square evenly (Roberts 2018, the plastic number's R2 sequence).
glm::dvec2 r2_point(int i) {
  constexpr double kPlastic = 1.32471795724474602596;
  const double x = 0.5 + (i + 1) / kPlastic, y = 0.5 + (i + 1) / (kPlastic * kPlastic);
  return {x - std::floor(x), y - std::floor(y)};
}

/// Points of a box in -1/2..1/2, the outermost ones and the middle first: where those are all free, or none, so are
/// all. (With evenly spread ones first, a penumbra would begin with a jump.)
std::vector<glm::dvec2> box_points() {
  std::vector<glm::dvec2> rest, points;
  for (int i = 0; i < kBoxPoints; ++i) rest.push_back(r2_point(i) - 0.5);
  for (const glm::dvec2 target : {glm::dvec2(-0.5, -0.5), {0.5, 0.5}, {-0.5, 0.5}, {0.5, -0.5}, {0, 0}, {0, -0.5},
                                  {0, 0.5}, {-0.5, 0}, {0.5, 0}}) {
    const auto nearest = std::min_element(rest.begin(), rest.end(), [&](const glm::dvec2& a, const glm::dvec2& b) {
      return glm::distance(a, target) < glm::distance(b, target);
    });
    points.push_back(*nearest);
    rest.erase(nearest);
  }
  points.insert(points.end(), rest.begin(), rest.end());
  return points;
}

/// Directions spread evenly over the sphere (spherical Fibonacci points).
std::vector<glm::vec3> sphere_directions(int n) {
  std::vector<glm::vec3> d;
  for (int i = 0; i < n; ++i) {
    const double z = 1 - (2 * i + 1.0) / n, r = std::sqrt(1 - z * z), a = i * std::numbers::pi * (3 - std::sqrt(5.0));
    d.push_back(glm::vec3(r * std::cos(a), r * std::sin(a), z));
  }
  return d;
}

Softbox make_box(const Studio& s, const glm::dvec3& from, double side, const glm::dvec3& colour) {
  Softbox b;
  b.center_m = s.center_m + kReach * s.radius_m * from;
  b.toward = -from;
  const glm::dvec3 helper = std::abs(from.z) < 0.99 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
  b.side_a_m = glm::normalize(glm::cross(helper, from)) * side;
  b.side_b_m = glm::cross(from, b.side_a_m);
  b.colour = colour;
  // So that the middle, facing the box, gets irradiance pi * colour.
  double form = 0;
  for (int i = 0; i < kBoxPoints; ++i) {
    const glm::dvec2 q = r2_point(i) - 0.5;
    const glm::dvec3 d = b.center_m + q.x * b.side_a_m + q.y * b.side_b_m - s.center_m;
    const double d2 = glm::dot(d, d), cosine = glm::dot(d, from) / std::sqrt(d2);
    form += cosine * cosine / d2 * side * side / kBoxPoints;
  }
  b.radiance = colour * (std::numbers::pi / form);
  return b;
}

/// A place that light reaches.
struct Place {
  glm::vec3 position, normal;
  float lift;  ///< rays start this far above the surface
  bool fine;   ///< seen
  bool thin = false;  ///< of a leaf: how light depends on the normal is worked out, too
};

/// How irradiance over pi changes when the normal leans, and what comes from the boxes (SideLight).
struct Lean {
  glm::mat3 gradient{0.0f};
  glm::vec2 boxes{0.0f};
};

/// Light of the room from evenly spread directions.
struct Sky {
  std::vector<glm::vec3> directions, radiance;
  Sky(const Studio& studio, int n) : directions(sphere_directions(n)) {
    for (const glm::vec3& d : directions) radiance.push_back(glm::vec3(studio.room(glm::dvec3(d))));
  }
};

/// Sends rays from places and remembers what they hit, so that light can go on from there.
class Gatherer {
 public:
  Gatherer(const Studio& studio, const SceneTree& tree)
      : studio_(studio), tree_(tree.tree), faces_(tree.faces), fine_(studio, kDirections), coarse_(studio, kCoarseDirections) {
    for (const Softbox& b : studio.boxes)
      for (const glm::dvec2& q : box_points())
        box_points_.push_back(glm::vec3(b.center_m + q.x * b.side_a_m + q.y * b.side_b_m));
  }

  struct Gathered {
    std::vector<glm::vec3> first;    ///< irradiance over pi straight from boxes and room
    std::vector<Lean> lean;          ///< of places on leaves; empty when there are none
    std::vector<std::size_t> start;  ///< where the hits of each place begin
    std::vector<int> hits;           ///< patch (face, then node of the paper) or -1, one a direction above the place
  };

  Gathered gather(std::span<const Place> places) const {
    Gathered g;
    g.first.resize(places.size());
    g.start.reserve(places.size() + 1);
    g.start.push_back(0);
    for (const Place& p : places) g.start.push_back(g.start.back() + count_above(p));
    g.hits.assign(g.start.back(), -1);
    if (std::any_of(places.begin(), places.end(), [](const Place& p) { return p.thin; })) g.lean.resize(places.size());
    parallel_for(places.size(), 256, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        Lean* lean = places[i].thin ? &g.lean[i] : nullptr;
        g.first[i] = from_boxes(places[i], lean) + from_room(places[i], g.hits.data() + g.start[i], lean);
      }
    });
    return g;
  }

  /// Irradiance over pi from patches that shine with `radiance`.
  glm::vec3 bounced(const Place& p, const int* hits, std::span<const glm::vec3> radiance) const {
    glm::vec3 sum(0.0f);
    float all = 0;
    for (const glm::vec3& d : sky(p).directions) {
      const float cosine = glm::dot(d, p.normal);
      if (cosine <= 0) continue;
      all += cosine;
      const int patch = *hits++;
      if (patch >= 0) sum += cosine * radiance[std::size_t(patch)];
    }
    return all > 0 ? sum / all : sum;
  }

 private:
  const Sky& sky(const Place& p) const { return p.fine ? fine_ : coarse_; }
  std::size_t count_above(const Place& p) const {
    const auto& d = sky(p).directions;
    return std::size_t(std::count_if(d.begin(), d.end(), [&](const glm::vec3& x) { return glm::dot(x, p.normal) > 0; }));
  }

  glm::vec3 from_boxes(const Place& p, Lean* lean) const {
    const glm::vec3 start = p.position + p.lift * p.normal;
    glm::vec3 sum(0.0f);
    for (std::size_t b = 0; b < studio_.boxes.size(); ++b) {
      const Softbox& box = studio_.boxes[b];
      const float area = float(glm::length(box.side_a_m) * glm::length(box.side_b_m));
      const glm::vec3 light =
          glm::vec3(box.radiance) * (shining(p, start, b) * area / (kBoxPoints * std::numbers::pi_v<float>));
      sum += light;
      if (!lean) continue;
      // As if all of a box's light came from its middle; where it grazes, a leaning normal would gain without bound.
      constexpr float kGrazing = 0.15f;
      const glm::vec3 d = glm::normalize(glm::vec3(box.center_m) - p.position);
      const glm::vec3 facing = light / std::max(glm::dot(d, p.normal), kGrazing);
      for (int c = 0; c < 3; ++c) lean->gradient[c] += facing[c] * d;
      if (b < 2 && box.colour.y > 0) lean->boxes[int(b)] = facing.y / float(box.colour.y);
    }
    return sum;
  }

  /// Sum of cos cos / distance^2 over the points of a box that reach the place. When all of the first points do,
  /// or none, so do all.
  float shining(const Place& p, const glm::vec3& start, std::size_t b) const {
    const glm::vec3 toward(studio_.boxes[b].toward);
    float whole = 0, tried = 0, free = 0;
    int n = p.fine ? kProbes : kCoarsePoints;
    for (int i = 0; i < kBoxPoints; ++i) {
      glm::vec3 d = box_points_[b * kBoxPoints + std::size_t(i)] - p.position;
      const float distance = glm::length(d);
      d /= distance;
      const float form = std::max(0.0f, glm::dot(d, p.normal)) * std::max(0.0f, -glm::dot(d, toward)) / (distance * distance);
      whole += form;
      if (form <= 0 || i >= n) continue;
      tried += form;
      if (!tree_.blocked(start, d, distance)) free += form;
      if (p.fine && i == kProbes - 1 && free > 0 && free < tried) n = kBoxPoints;
    }
    return tried > 0 ? whole * free / tried : 0.0f;
  }

  glm::vec3 from_room(const Place& p, int* hits, Lean* lean) const {
    const glm::vec3 start = p.position + p.lift * p.normal;
    const bool paper = !studio_.paper.empty();
    const float far = float(100 * studio_.radius_m), level = paper ? float(studio_.paper.level_m()) : 0.0f;
    const Sky& room = sky(p);
    glm::vec3 sum(0.0f);
    glm::mat3 gradient(0.0f);
    float all = 0;
    for (std::size_t k = 0; k < room.directions.size(); ++k) {
      const glm::vec3& d = room.directions[k];
      const float cosine = glm::dot(d, p.normal);
      if (cosine <= 0) continue;
      all += cosine;
      int& hit = *hits++;
      float reach = far;
      if (paper && d.z < 0) reach = std::min(far, std::max(0.0f, (level - start.z) / d.z));
      hit = tree_.first_hit(start, d, reach);
      if (hit < 0 && reach < far) {
        const int node = studio_.paper.nearest(start.x + reach * d.x, start.y + reach * d.y);
        if (node >= 0) hit = faces_ + node;
      }
      if (hit >= 0) continue;
      sum += cosine * room.radiance[k];
      if (lean)
        for (int c = 0; c < 3; ++c) gradient[c] += room.radiance[k][c] * d;
    }
    if (lean && all > 0) lean->gradient += gradient / all;
    return all > 0 ? sum / all : sum;
  }

  const Studio& studio_;
  const TriangleTree& tree_;
  int faces_;
  Sky fine_, coarse_;
  std::vector<glm::vec3> box_points_;
};

/// How far above the surface rays may start: a fraction of the edges there, so that a curved surface made of flat
/// faces does not shade itself where light grazes.
std::vector<float> lifts(const LitMesh& m) {
  std::vector<float> sum(m.vertices.size(), 0.0f);
  std::vector<int> count(m.vertices.size(), 0);
  for (const auto& t : m.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = std::size_t(t[k]), b = std::size_t(t[(k + 1) % 3]);
      const float length = glm::distance(m.vertices[a].position_m, m.vertices[b].position_m);
      sum[a] += length;
      sum[b] += length;
      ++count[a];
      ++count[b];
    }
  for (std::size_t v = 0; v < sum.size(); ++v) sum[v] = 0.15f * sum[v] / float(std::max(1, count[v]));
  return sum;
}

}  // namespace

glm::dvec3 Studio::room(const glm::dvec3& d) const {
  return d.z >= 0 ? glm::mix(horizon, zenith, d.z) : glm::mix(horizon, nadir, std::min(1.0, -4 * d.z));
}

Studio make_studio(const ObjectSceneInput& in) {
  const Bounds box = bounds_of(in.objects);
  Studio s;
  s.center_m = 0.5 * (box.low + box.high);
  s.radius_m = std::max(0.5 * glm::length(box.high - box.low), 1e-6);
  const glm::dvec3 to_key = in.still.sun.direction();
  const glm::dvec3 view = in.still.camera.look_at_m - in.still.camera.position_m, level(view.x, view.y, 0);
  // Seen from straight above, the picture's top is behind.
  const glm::dvec3 away = glm::length(level) > 1e-9 * glm::length(view) ? glm::normalize(level) : glm::dvec3(0, 1, 0);
  const glm::dvec3 across = glm::cross(away, glm::dvec3(0, 0, 1));
  const double other = glm::dot(to_key, across) > 0 ? -1 : 1;
  const glm::dvec3 warm(1.02, 1.0, 0.96), cool(0.97, 0.995, 1.04);
  const double side = 2 * in.key_size * s.radius_m;
  s.boxes.push_back(make_box(s, to_key, side, warm));
  if (in.rim > 0)
    s.boxes.push_back(make_box(s, glm::normalize(away * 0.8 + across * (0.55 * other) + glm::dvec3(0, 0, 0.75)),
                               0.6 * side, cool * in.rim));
  if (in.backdrop == Backdrop::sky) {
    s.zenith = glm::dvec3(0.30, 0.52, 1.0) * in.fill;
    s.horizon = glm::dvec3(1.5, 1.65, 1.75) * in.fill;
    s.nadir = glm::dvec3(0.22, 0.30, 0.13) * in.fill;
    return s;
  }
  s.zenith = cool * (1.1 * in.fill);
  s.horizon = cool * (0.55 * in.fill);
  s.nadir = s.horizon;
  if (in.backdrop == Backdrop::dark) s.paper_rgb = glm::dvec3(0.010, 0.010, 0.011);
  const glm::dvec3 half = 0.5 * (box.high - box.low);
  const double wide = std::abs(across.x) * half.x + std::abs(across.y) * half.y;
  const double deep = std::abs(away.x) * half.x + std::abs(away.y) * half.y;
  const double margin = 0.3 * s.radius_m;
  const double ground = box.low.z - in.ground_gap_m - 1e-4 * s.radius_m;
  s.paper = Paper({s.center_m.x, s.center_m.y, ground}, away, 1.3 * wide + margin, 1.3 * deep + margin, s.radius_m,
                  std::clamp(in.still.width_px * 3 / 4, 64, 640));
  return s;
}

namespace {

/// The numbers of a mesh's places: fronts, and backs of leaves.
struct Part {
  std::size_t front, back;
};

std::vector<Place> make_places(const Studio& studio, const View& view, const SceneTree& tree,
                               std::span<const LitMesh> meshes, std::vector<Part>& parts) {
  std::vector<Place> places;
  for (const LitMesh& m : meshes) {
    const auto lift = lifts(m);
    Part part{places.size(), 0};
    const auto side = [&](float sign) {
      for (std::size_t v = 0; v < m.vertices.size(); ++v)
        places.push_back({m.vertices[v].position_m, sign * m.vertices[v].normal, lift[v], m.vertices[v].seen, m.thin});
    };
    side(1);
    part.back = places.size();
    if (m.thin) side(-1);
    parts.push_back(part);
  }
  const int n = studio.paper.nodes();
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const Paper::Node node = studio.paper.node(i, j);
      const glm::vec3 p(node.position_m);
      places.push_back({p, glm::vec3(node.normal), 0.0f, view.contains(p)});
    }
  (void)tree;
  return places;
}

/// What leaves the vertices of a mesh when `irradiance` (over pi) falls on them.
Glow reflect(const LitMesh& m, const Part& part, const std::vector<glm::vec3>& irradiance) {
  const auto spread = [&](std::size_t from) {
    const auto begin = irradiance.begin() + std::ptrdiff_t(from);
    return spread_light(m, {begin, begin + std::ptrdiff_t(m.vertices.size())});
  };
  const auto above = spread(part.front);
  const auto below = m.thin ? spread(part.back) : above;
  Glow g;
  g.front.resize(m.vertices.size());
  g.back.resize(m.thin ? m.vertices.size() : 0);
  for (std::size_t v = 0; v < m.vertices.size(); ++v) {
    const LitVertex& x = m.vertices[v];
    g.front[v] = x.front * above[v] + x.through * below[v];
    if (m.thin) g.back[v] = x.back * below[v] + x.through * above[v];
  }
  return g;
}

SideLight side_light(std::size_t from, std::size_t count, const std::vector<glm::vec3>& irradiance,
                     const std::vector<Lean>& lean) {
  SideLight s;
  for (std::size_t i = from; i < from + count; ++i) {
    s.irradiance.push_back(irradiance[i]);
    s.lean.push_back(lean[i].gradient);
    s.boxes.push_back(lean[i].boxes);
  }
  return s;
}

/// Mean over the parts of every placed face.
void add_patches(const LitMesh& m, const Glow& g, std::span<glm::vec3> radiance) {
  std::vector<float> area(radiance.size(), 0.0f);
  for (std::size_t f = 0; f < m.triangles.size(); ++f) {
    const auto& t = m.triangles[f];
    const std::size_t a = std::size_t(t[0]), b = std::size_t(t[1]), c = std::size_t(t[2]), base = std::size_t(m.base[f]);
    const glm::vec3 p = m.vertices[a].position_m;
    const float own = glm::length(glm::cross(m.vertices[b].position_m - p, m.vertices[c].position_m - p)) + 1e-20f;
    radiance[base] += (g.front[a] + g.front[b] + g.front[c]) * (own / 3);
    area[base] += own;
  }
  for (std::size_t f = 0; f < area.size(); ++f)
    if (area[f] > 0) radiance[f] /= area[f];
}

/// A leaf's margin hangs far above the paper: where its shadow is wide, the few rays of a node that tell whether more
/// are needed would show as steps. Binomial mean over seven nodes, along both sides.
void soften(std::vector<glm::vec3>& node, int n) {
  constexpr float kShare[7] = {1 / 64.0f, 6 / 64.0f, 15 / 64.0f, 20 / 64.0f, 15 / 64.0f, 6 / 64.0f, 1 / 64.0f};
  for (const int step : {1, n}) {
    const std::vector<glm::vec3> before = node;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const int at = step == 1 ? i : j;
        glm::vec3 sum(0.0f);
        for (int k = -3; k <= 3; ++k)
          sum += kShare[k + 3] * before[std::size_t(j * n + i + (std::clamp(at + k, 0, n - 1) - at) * step)];
        node[std::size_t(j * n + i)] = sum;
      }
  }
}

}  // namespace

StudioGlow light_studio(const Studio& studio, const View& view, const SceneTree& tree, std::span<const LitMesh> meshes) {
  std::vector<Part> parts;
  const std::vector<Place> places = make_places(studio, view, tree, meshes, parts);
  const std::size_t nodes = std::size_t(studio.paper.nodes()) * std::size_t(studio.paper.nodes());
  const Gatherer gatherer(studio, tree);
  const auto gathered = gatherer.gather(places);
  std::vector<glm::vec3> irradiance = gathered.first, radiance(std::size_t(tree.faces) + nodes);
  StudioGlow glow;
  for (int bounce = 0;; ++bounce) {
    std::fill(radiance.begin(), radiance.end(), glm::vec3(0.0f));
    glow.meshes.clear();
    for (std::size_t k = 0; k < meshes.size(); ++k) {
      glow.meshes.push_back(reflect(meshes[k], parts[k], irradiance));
      const std::size_t from = std::size_t(tree.first[k]), to = std::size_t(k + 1 < meshes.size() ? tree.first[k + 1] : tree.faces);
      add_patches(meshes[k], glow.meshes[k], std::span(radiance).subspan(from, to - from));
    }
    for (std::size_t i = 0; i < nodes; ++i)
      radiance[std::size_t(tree.faces) + i] = glm::vec3(studio.paper_rgb) * irradiance[places.size() - nodes + i];
    if (bounce == kBounces) break;
    parallel_for(places.size(), 1024, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        irradiance[i] = gathered.first[i] + gatherer.bounced(places[i], gathered.hits.data() + gathered.start[i], radiance);
    });
  }
  for (std::size_t k = 0; k < meshes.size(); ++k) {
    if (!meshes[k].thin) continue;
    const std::size_t n = meshes[k].vertices.size();
    glow.meshes[k].above = side_light(parts[k].front, n, irradiance, gathered.lean);
    glow.meshes[k].below = side_light(parts[k].back, n, irradiance, gathered.lean);
  }
  glow.paper.assign(radiance.end() - std::ptrdiff_t(nodes), radiance.end());
  if (std::any_of(meshes.begin(), meshes.end(), [](const LitMesh& m) { return m.thin; }))
    soften(glow.paper, studio.paper.nodes());
  return glow;
}

}  // namespace witherfield::pov
