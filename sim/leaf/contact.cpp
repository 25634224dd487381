#include "sim/leaf/contact.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "sim/core/parallel.hpp"
#include "sim/leaf/point_grid.hpp"

namespace witherfield::leaf {
namespace {
constexpr double kStiffness_N_m = 60;  // a vertex's weight (some microneton) presses a pair together by a few per cent of its gap
}

Contact::Contact(std::vector<glm::dvec3> rest, std::vector<double> radius, double neighbour)
    : rest_(std::move(rest)), radius_(std::move(radius)), neighbour_(neighbour) {
  for (const double r : radius_) largest_ = std::max(largest_, r);
}

std::vector<Contact::Pair> Contact::find(std::span<const glm::dvec3> x, double reach) const {
  std::vector<Pair> pairs;
  if (radius_.empty()) return pairs;
  const std::span<const glm::dvec3> points = x.first(radius_.size());
  const PointGrid grid(points, 2 * largest_ + reach);
  constexpr std::size_t kBatch = 256;
  std::vector<std::vector<Pair>> found((points.size() + kBatch - 1) / kBatch);
  parallel_for(found.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t batch = begin; batch < end; ++batch)
      for (std::size_t a = batch * kBatch; a < std::min(points.size(), (batch + 1) * kBatch); ++a)
        grid.near(points[a], [&](int b) {
          if (b <= int(a)) return;
          const double apart = radius_[a] + radius_[std::size_t(b)];
          const glm::dvec3 d = points[a] - points[std::size_t(b)], r = rest_[a] - rest_[std::size_t(b)];
          if (glm::dot(d, d) >= (apart + reach) * (apart + reach) || glm::dot(r, r) <= neighbour_ * neighbour_) return;
          const double gap = std::min(apart, 0.6 * glm::length(r));
          if (glm::dot(d, d) < (gap + reach) * (gap + reach)) found[batch].push_back({int(a), b, gap});
        });
  });
  for (const auto& f : found) pairs.insert(pairs.end(), f.begin(), f.end());
  return pairs;
}

double Contact::energy(std::span<const glm::dvec3> x) const {
  double sum = 0;
  for (const Pair& p : find(x, 0)) {
    const glm::dvec3 d = x[std::size_t(p.a)] - x[std::size_t(p.b)];
    const double square = glm::dot(d, d);
    if (square >= p.gap_m * p.gap_m) continue;
    const double c = p.gap_m - std::sqrt(square);
    sum += kStiffness_N_m * c * c * c / (3 * p.gap_m);
  }
  return sum;
}

double Contact::assemble(std::span<const glm::dvec3> x, std::span<glm::dvec3> gradient, BlockMatrix& h) const {
  double sum = 0;
  for (const Pair& p : find(x, 0)) {
    const glm::dvec3 d = x[std::size_t(p.a)] - x[std::size_t(p.b)];
    const double square = glm::dot(d, d);
    if (square >= p.gap_m * p.gap_m) continue;
    const double distance = std::max(std::sqrt(square), 1e-12), c = p.gap_m - distance;
    const glm::dvec3 n = d / distance, push = n * (kStiffness_N_m * c * c / p.gap_m);
    sum += kStiffness_N_m * c * c * c / (3 * p.gap_m);
    gradient[std::size_t(p.a)] -= push;
    gradient[std::size_t(p.b)] += push;
    // |u_a - u_b|^2 <= 2 |u_a|^2 + 2 |u_b|^2; the part across n is negative and left out.
    const glm::dmat3 k = glm::outerProduct(n, n) * (4 * kStiffness_N_m * c / p.gap_m);
    h.add_diagonal(p.a, k);
    h.add_diagonal(p.b, k);
  }
  return sum;
}

bool Contact::allows(std::span<const glm::dvec3> from, std::span<const glm::dvec3> to) const {
  if (radius_.empty()) return true;
  double longest = 0;
  for (std::size_t i = 0; i < radius_.size(); ++i) longest = std::max(longest, glm::distance(from[i], to[i]));
  // In pieces: pairs that can meet within one piece are within reach at its beginning.
  const double piece = 4 * largest_;
  const int pieces = std::max(1, int(std::ceil(longest / piece)));
  std::vector<glm::dvec3> x(radius_.size());
  for (int k = 0; k < pieces; ++k) {
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = glm::mix(from[i], to[i], double(k) / pieces);
    const std::vector<Pair> pairs = find(x, 2 * longest / pieces);
    const bool free = std::all_of(pairs.begin(), pairs.end(), [&](const Pair& p) {
      const std::size_t a = std::size_t(p.a), b = std::size_t(p.b);
      const glm::dvec3 d = x[a] - x[b], u = ((to[a] - from[a]) - (to[b] - from[b])) / double(pieces);
      const double uu = glm::dot(u, u), when = uu > 0 ? std::clamp(-glm::dot(d, u) / uu, 0.0, 1.0) : 0.0;
      const glm::dvec3 nearest = d + when * u;
      return glm::dot(nearest, nearest) >= std::min(0.36 * p.gap_m * p.gap_m, 0.8 * glm::dot(d, d));
    });
    if (!free) return false;
  }
  return true;
}

int Contact::touching(std::span<const glm::dvec3> x) const { return int(find(x, 0).size()); }

}  // namespace witherfield::leaf
