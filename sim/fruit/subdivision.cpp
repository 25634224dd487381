// The public face of the refinement.
#include "sim/fruit/subdivision.hpp"

#include <atomic>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

#include "sim/core/errors.hpp"
#include "sim/core/fields.hpp"
#include "sim/fruit/refinement_tables.hpp"

namespace witherfield::fruit {
namespace {

// Arrays of vectors and of triangles are read as flat arrays.
static_assert(sizeof(glm::dvec3) == 3 * sizeof(double) && sizeof(glm::vec3) == 3 * sizeof(float));
static_assert(sizeof(glm::dvec2) == 2 * sizeof(double) && sizeof(std::array<int, 3>) == 3 * sizeof(int));

constexpr int kMaxSteps = 8;

void check_size(const ControlMesh& mesh, int steps) {
  if (steps < 0 || steps > kMaxSteps)
    throw InvalidInput("subdivision: steps is " + std::to_string(steps) + ", must be 0.." +
                       std::to_string(kMaxSteps));
  constexpr std::size_t limit = std::size_t(std::numeric_limits<int>::max());
  const std::size_t corners =
      3 * mesh.triangles.size();  // more than edges and, but for strays, than vertices
  if (mesh.position_m.size() > limit || corners > (limit >> (2 * steps)) ||
      mesh.position_m.size() + (corners << (2 * steps)) > limit)
    throw InvalidInput("subdivision: " + std::to_string(mesh.triangles.size()) + " triangles after " +
                       std::to_string(steps) + " steps need more than 2^31 - 1 indices");
}

void check_length(std::size_t length, std::size_t wanted, const char* what) {
  if (length != wanted)
    throw InvalidInput(std::string("subdivision: ") + what + " values are " + std::to_string(length) +
                       ", must be " + std::to_string(wanted));
}

/// Numbers of things: a mean of two means nothing.
bool is_a_label(const std::string& field) {
  return field.ends_with("_id") || field == "tissue" || field == "vein" || field == "lod" ||
         field == "rotation";
}

}  // namespace

Refinement::Refinement(const ControlMesh& topology, Scheme scheme, int steps)
    : Refinement(topology, scheme, steps, Refinement(nullptr)) {}

Refinement::Refinement(const ControlMesh& topology, Scheme scheme, int steps, Refinement&& old) {
  check_size(topology, steps);
  auto tables = std::make_shared<Tables>();
  tables->scheme = scheme;
  tables->steps = steps;
  tables->base = analyse(topology, scheme);
  if (old.tables_ && old.tables_.use_count() == 1) {
    std::atomic_thread_fence(std::memory_order_acquire);  // what other threads did with copies that are gone
    tables->memory = std::move(old.tables_->memory);
    old.tables_.reset();
  }
  tables->build(topology);
  tables_ = std::move(tables);
}

std::size_t Refinement::control_vertices() const {
  return std::size_t(tables_->base.vertices);
}
std::size_t Refinement::vertices() const {
  return std::size_t(tables_->levels.back().vertices);
}
std::size_t Refinement::faces() const {
  return std::size_t(tables_->levels.back().faces);
}
int Refinement::steps() const {
  return tables_->steps;
}
std::span<const VertexRule> Refinement::rules() const {
  return {tables_->rules, vertices()};
}

std::span<const std::array<int, 3>> Refinement::triangles() const {
  return {reinterpret_cast<const std::array<int, 3>*>(tables_->levels.back().corner), faces()};
}

std::vector<int> Refinement::control_vertex() const {
  std::vector<int> origin(vertices());
  for (std::size_t v = 0; v < control_vertices(); ++v) origin[v] = int(v);
  for (int k = 0; k < steps(); ++k) {
    const Level& level = tables_->levels[std::size_t(k)];
    for (std::size_t h = 0; h < 3 * std::size_t(level.faces); ++h) {
      const int a = level.corner[h], b = level.corner[h % 3 == 2 ? h - 2 : h + 1];
      origin[std::size_t(level.vertices + level.edge_of[h])] = origin[std::size_t(std::min(a, b))];
    }
  }
  return origin;
}

void Refinement::evaluate(std::span<const glm::dvec3> control, std::span<glm::dvec3> refined) const {
  check_length(control.size(), control_vertices(), "control");
  check_length(refined.size(), vertices(), "refined");
  if (!control.empty()) evaluate_tables(*tables_, glm::value_ptr(control[0]), glm::value_ptr(refined[0]), 3);
}

void Refinement::evaluate(std::span<const glm::vec3> control, std::span<glm::vec3> refined) const {
  check_length(control.size(), control_vertices(), "control");
  check_length(refined.size(), vertices(), "refined");
  if (!control.empty()) evaluate_tables(*tables_, glm::value_ptr(control[0]), glm::value_ptr(refined[0]), 3);
}

void Refinement::evaluate(std::span<const float> control, std::span<float> refined, int channels) const {
  if (channels < 1)
    throw InvalidInput("subdivision: channels is " + std::to_string(channels) + ", must be 1 or more");
  check_length(control.size(), control_vertices() * std::size_t(channels), "control");
  check_length(refined.size(), vertices() * std::size_t(channels), "refined");
  evaluate_tables(*tables_, control.data(), refined.data(), channels);
}

void Refinement::evaluate_limit(std::span<const glm::dvec3> control, std::span<glm::dvec3> position,
                                std::span<glm::dvec3> normal) const {
  check_length(position.size(), vertices(), "limit position");
  check_length(normal.size(), vertices(), "limit normal");
  std::vector<glm::dvec3> refined(vertices());
  evaluate(control, refined);
  limit_of_tables(*tables_, refined, position, normal);
}

Surface refine(const Refinement& refinement, const Surface& control, bool to_limit) {
  control.validate();
  check_length(control.position_m.size(), refinement.control_vertices(), "control");
  check_length(control.triangles.size() << (2 * refinement.steps()), refinement.faces(), "refined triangle");
  Surface out;
  out.triangles.assign(refinement.triangles().begin(), refinement.triangles().end());
  out.position_m.resize(refinement.vertices());
  if (to_limit) {
    out.normal.resize(refinement.vertices());
    refinement.evaluate_limit(control.position_m, out.position_m, out.normal);
  } else {
    refinement.evaluate(control.position_m, out.position_m);
  }
  if (!control.uv.empty()) {
    std::vector<glm::dvec3> flat(control.uv.size()), fine(refinement.vertices());
    for (std::size_t v = 0; v < flat.size(); ++v) flat[v] = {control.uv[v], 0};
    refinement.evaluate(flat, fine);
    out.uv.assign(fine.begin(), fine.end());
  }
  std::vector<int> origin;
  for (const SurfaceField& field : control.fields) {
    const auto n = std::size_t(field_spec(field.name).components);
    SurfaceField& fine = out.make_field(field.name, field.on_faces);
    if (field.on_faces) {
      for (std::size_t f = 0; f < out.triangles.size(); ++f)
        std::copy_n(field.values.begin() + std::ptrdiff_t((f >> (2 * refinement.steps())) * n), n,
                    fine.values.begin() + std::ptrdiff_t(f * n));
    } else if (field.name == "sharpness") {
      for (std::size_t v = 0; v < fine.values.size(); ++v) fine.values[v] = float(refinement.rules()[v]);
    } else if (is_a_label(field.name)) {
      if (origin.empty()) origin = refinement.control_vertex();
      for (std::size_t v = 0; v < origin.size(); ++v)
        std::copy_n(field.values.begin() + std::ptrdiff_t(std::size_t(origin[v]) * n), n,
                    fine.values.begin() + std::ptrdiff_t(v * n));
    } else {
      refinement.evaluate(field.values, fine.values, int(n));
    }
  }
  return out;
}

}  // namespace witherfield::fruit
