#include "sim/leaf/step_path.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "sim/core/parallel.hpp"
#include "sim/leaf/cotangent.hpp"

namespace witherfield::leaf {
namespace {

glm::dvec3 rotate(const glm::dvec3& v, const glm::dvec3& rotation) {
  return turned(glm::dquat(1, 0, 0, 0), rotation) * v;
}

/// The rotation in the change (d1, d2) of a triangle's gradient (f1, f2): its normal's tilt and the spin in its plane.
glm::dvec3 spin(const glm::dvec3& f1, const glm::dvec3& f2, const glm::dvec3& d1, const glm::dvec3& d2) {
  const double a11 = glm::dot(f1, f1), a12 = glm::dot(f1, f2), a22 = glm::dot(f2, f2), det = a11 * a22 - a12 * a12;
  const glm::dvec3 c1 = (f1 * a22 - f2 * a12) / det, c2 = (f2 * a11 - f1 * a12) / det;  // dual tangents: c_a . f_b = delta_ab
  const glm::dvec3 n = glm::normalize(glm::cross(f1, f2));
  const glm::dvec3 tilt = c1 * glm::dot(d1, n) + c2 * glm::dot(d2, n);
  // Mean of the turns of all directions in the plane: half the surface curl.
  const double about_n = 0.5 * glm::dot(n, glm::cross(c1, d1) + glm::cross(c2, d2));
  return glm::cross(tilt, n) + about_n * n;
}

}  // namespace

StepPath::StepPath(std::span<const glm::dvec3> rest, const std::vector<ShellPatch>& patches, std::vector<int> clamp, int rod_nodes)
    : patches_(&patches), clamp_(std::move(clamp)), vertices_(rest.size()), rod_nodes_(std::size_t(rod_nodes)) {
  std::vector<std::array<int, 3>> triangles;
  for (const ShellPatch& p : patches) triangles.push_back(p.corner);
  const SparseMatrix l = cotangent_laplacian(rest, triangles);
  double largest = 0;
  for (const double v : l.value) largest = std::max(largest, v);
  anchor_ = 1e6 * largest;
  std::vector<double> d(vertices_, 1e-12 * largest);  // vertices without a triangle stay where they are
  for (const int v : clamp_) d[std::size_t(v)] = anchor_;
  poisson_ = std::make_unique<SparseCholesky>(scaled_plus_diagonal(l, 0.5, d), Factor::sparse);
}

void StepPath::move_rod(const WiltShape& from, std::span<const glm::dvec3> step, double share, WiltShape& to) const {
  const std::size_t frames = from.x.size();  // first rotation in `step`
  for (std::size_t k = 0; k < from.frame.size(); ++k) to.frame[k] = turned(from.frame[k], share * step[frames + k]);
  if (rod_nodes_ == 0) return;
  to.x[vertices_] = from.x[vertices_] + share * step[vertices_];
  for (std::size_t k = 0; k + 1 < rod_nodes_; ++k) {
    const std::size_t a = vertices_ + k;
    const glm::dvec3 d = from.x[a + 1] - from.x[a], turn = step[frames + k];
    const glm::dvec3 stretch = step[a + 1] - step[a] - glm::cross(turn, d);
    to.x[a + 1] = to.x[a] + rotate(d + share * stretch, share * turn);
  }
}

void StepPath::move_blade(const WiltShape& from, std::span<const glm::dvec3> step, double share, WiltShape& to) const {
  std::vector<std::array<glm::dvec3, 3>> part(patches_->size());
  parallel_for(part.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const ShellPatch& p = (*patches_)[t];
      glm::dvec3 f1(0.0), f2(0.0), d1(0.0), d2(0.0);
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t v = std::size_t(p.corner[i]);
        f1 += from.x[v] * p.gradient[i].x;
        f2 += from.x[v] * p.gradient[i].y;
        d1 += step[v] * p.gradient[i].x;
        d2 += step[v] * p.gradient[i].y;
      }
      const glm::dvec3 w = spin(f1, f2, d1, d2);
      const glm::dquat q = turned(glm::dquat(1, 0, 0, 0), share * w);
      const glm::dvec3 g1 = q * (f1 + share * (d1 - glm::cross(w, f1))) - f1, g2 = q * (f2 + share * (d2 - glm::cross(w, f2))) - f2;
      for (std::size_t i = 0; i < 3; ++i) part[t][i] = p.area_m2 * (g1 * p.gradient[i].x + g2 * p.gradient[i].y);
    }
  });
  std::vector<double> move(3 * vertices_, 0.0);
  const auto add = [&](int v, const glm::dvec3& d) {
    for (int c = 0; c < 3; ++c) move[3 * std::size_t(v) + std::size_t(c)] += d[c];
  };
  for (std::size_t t = 0; t < part.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) add((*patches_)[t].corner[i], part[t][i]);
  std::vector<glm::dvec3> held;
  for (const int v : clamp_) {
    const std::size_t i = std::size_t(v);
    if (rod_nodes_ == 0) {
      held.push_back(share * step[i]);
    } else {  // rigidly with the rod's end
      const std::size_t end = vertices_ + rod_nodes_ - 1, last = from.x.size() + from.frame.size() - 1;
      const glm::dvec3 d = from.x[i] - from.x[end], turn = step[last];
      const glm::dvec3 slip = step[i] - step[end] - glm::cross(turn, d);
      held.push_back(to.x[end] + rotate(d + share * slip, share * turn) - from.x[i]);
    }
    add(v, anchor_ * held.back());
  }
  poisson_->solve(move, move, 3);
  for (std::size_t v = 0; v < vertices_; ++v) to.x[v] = from.x[v] + glm::dvec3(move[3 * v], move[3 * v + 1], move[3 * v + 2]);
  for (std::size_t k = 0; k < clamp_.size(); ++k) to.x[std::size_t(clamp_[k])] = from.x[std::size_t(clamp_[k])] + held[k];
}

WiltShape StepPath::at(const WiltShape& from, std::span<const glm::dvec3> step, double share) const {
  WiltShape to = from;
  move_rod(from, step, share, to);
  move_blade(from, step, share, to);
  return to;
}

}  // namespace witherfield::leaf
