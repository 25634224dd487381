#include "sim/leaf/petiole_rod.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

namespace witherfield::leaf {
namespace {

/// Holds a vertex of the blade to the rod's end; stiff enough that the whole weight moves it by a micrometre or so.
constexpr double kHold_N_m = 2e4;

/// [v]x: cross product as a matrix.
glm::dmat3 cross_matrix(const glm::dvec3& v) { return {0, v.z, -v.y, -v.z, 0, v.x, v.y, -v.x, 0}; }

std::vector<glm::dvec3> resample(const std::vector<glm::dvec3>& line, int segments) {
  std::vector<double> arc{0.0};
  for (std::size_t k = 1; k < line.size(); ++k) arc.push_back(arc.back() + glm::distance(line[k], line[k - 1]));
  std::vector<glm::dvec3> out;
  std::size_t k = 1;
  for (int i = 0; i <= segments; ++i) {
    const double s = arc.back() * i / segments;
    while (k + 1 < line.size() && arc[k] < s) ++k;
    out.push_back(glm::mix(line[k - 1], line[k], std::clamp((s - arc[k - 1]) / (arc[k] - arc[k - 1]), 0.0, 1.0)));
  }
  return out;
}

/// The shortest turn that takes unit vector a to unit vector b.
glm::dquat shortest_turn(const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dquat q(1 + glm::dot(a, b), glm::cross(a, b));
  if (glm::dot(q, q) > 1e-12) return glm::normalize(q);
  const glm::dvec3 side = std::abs(a.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  return glm::dquat(0, glm::normalize(glm::cross(a, side)));
}

}  // namespace

glm::dquat turned(const glm::dquat& q, const glm::dvec3& d) {
  const double angle = glm::length(d);
  const double s = angle > 1e-12 ? std::sin(angle / 2) / angle : 0.5;
  return glm::normalize(glm::dquat(std::cos(angle / 2), d * s) * q);
}

PetioleRod::PetioleRod(const std::vector<glm::dvec3>& line, double radius_stem, double radius_end, int segments, int first_node,
                       int first_frame, std::vector<int> held, std::span<const glm::dvec3> blade)
    : first_node_(first_node), first_frame_(first_frame), radius_stem_(radius_stem), radius_end_(radius_end),
      rest_(resample(line, segments)), held_(std::move(held)) {
  glm::dvec3 along(0, 0, 1);
  glm::dquat q(1, 0, 0, 0);
  for (int s = 0; s < segments; ++s) {  // frames carried along the line without twist
    const glm::dvec3 d = rest_[std::size_t(s) + 1] - rest_[std::size_t(s)];
    length_.push_back(glm::length(d));
    q = shortest_turn(along, d / length_.back()) * q;
    along = d / length_.back();
    frame_.push_back(q);
    if (s > 0) rest_turn_.push_back(glm::conjugate(frame_[std::size_t(s) - 1]) * q);
  }
  for (const int v : held_) held_at_.push_back(glm::conjugate(q) * (blade[std::size_t(v)] - rest_.back()));
  modulus_.assign(std::size_t(segments), 0.0);
  preload_.assign(std::size_t(2 * segments - 1) + held_.size(), glm::dvec3(0.0));
}

double PetioleRod::radius_m(int node) const {
  return radius_stem_ + (radius_end_ - radius_stem_) * node / std::max(segments(), 1);
}

void PetioleRod::set_modulus(std::span<const double> segment_Pa) { modulus_.assign(segment_Pa.begin(), segment_Pa.end()); }

std::vector<std::pair<int, int>> PetioleRod::couplings() const {
  std::vector<std::pair<int, int>> pairs;
  for (int s = 0; s < segments(); ++s) {
    const int a = first_node_ + s, f = first_frame_ + s;
    pairs.insert(pairs.end(), {{a, a + 1}, {a, f}, {a + 1, f}});
    if (s > 0) pairs.emplace_back(f - 1, f);
  }
  const int end = first_node_ + segments(), f = first_frame_ + segments() - 1;
  if (!empty())
    for (const int v : held_) pairs.insert(pairs.end(), {{v, end}, {v, f}});
  return pairs;
}

template <class Visit>
void PetioleRod::each_term(const WiltShape& s, const Visit& visit) const {
  if (empty()) return;
  Term t;
  std::size_t number = 0;
  const auto done = [&] {
    t.r -= preload_[number];
    visit(t, number);
    ++number;
  };
  const auto inertia = [&](int k) {
    const double r = (radius_m(k) + radius_m(k + 1)) / 2;
    return std::numbers::pi * r * r * r * r / 4;
  };
  for (int k = 0; k < segments(); ++k) {  // stretch and shear: the segment against its frame's third axis
    const int a = first_node_ + k;
    const glm::dmat3 back = glm::transpose(glm::mat3_cast(s.frame[std::size_t(k)]));
    const double l = length_[std::size_t(k)], r = (radius_m(k) + radius_m(k + 1)) / 2;
    const glm::dvec3 d = (s.x[std::size_t(a) + 1] - s.x[std::size_t(a)]) / l;
    t.r = back * d - glm::dvec3(0, 0, 1);
    t.stiffness = glm::dvec3(modulus_[std::size_t(k)] * std::numbers::pi * r * r * l);
    t.count = 3;
    t.turn = false; t.arm = d; t.share = 1 / l;
    t.node[0] = a; t.derivative[0] = back * (-1 / l);
    t.node[1] = a + 1; t.derivative[1] = back * (1 / l);
    t.node[2] = first_frame_ + k; t.derivative[2] = back * cross_matrix(d);
    done();
  }
  for (int k = 1; k < segments(); ++k) {  // bending and twist: r = 2 Im(rest^-1 frame_a^-1 frame_b)
    const glm::dquat &a = s.frame[std::size_t(k) - 1], &b = s.frame[std::size_t(k)];
    glm::dquat q = glm::conjugate(rest_turn_[std::size_t(k) - 1]) * glm::conjugate(a) * b;
    if (q.w < 0) q = -q;
    const glm::dvec3 im(q.x, q.y, q.z);
    const double l = (length_[std::size_t(k) - 1] + length_[std::size_t(k)]) / 2;
    const double ei = (modulus_[std::size_t(k) - 1] * inertia(k - 1) + modulus_[std::size_t(k)] * inertia(k)) / 2;
    t.r = 2.0 * im;
    t.stiffness = glm::dvec3(ei, ei, ei * 2 / 3) / l;  // G J = E / 3 * 2 I
    t.count = 2;
    const glm::dmat3 turn = (glm::dmat3(q.w) + cross_matrix(im)) * glm::transpose(glm::mat3_cast(b));
    t.turn = true; t.arm = im;
    t.node[0] = first_frame_ + k - 1; t.derivative[0] = -turn;
    t.node[1] = first_frame_ + k; t.derivative[1] = turn;
    done();
  }
  const glm::dmat3 back = glm::transpose(glm::mat3_cast(s.frame.back()));
  const int end = first_node_ + segments();
  for (std::size_t k = 0; k < held_.size(); ++k) {
    const glm::dvec3 d = s.x[std::size_t(held_[k])] - s.x[std::size_t(end)];
    t.r = back * d - held_at_[k];
    t.stiffness = glm::dvec3(kHold_N_m);
    t.count = 3;
    t.turn = false; t.arm = d; t.share = 1;
    t.node[0] = end; t.derivative[0] = -back;
    t.node[1] = held_[k]; t.derivative[1] = back;
    t.node[2] = first_frame_ + segments() - 1; t.derivative[2] = back * cross_matrix(d);
    done();
  }
}

double PetioleRod::energy(const WiltShape& s) const {
  double sum = 0;
  each_term(s, [&](const Term& t, std::size_t) { sum += 0.5 * glm::dot(t.stiffness * t.r, t.r); });
  return sum;
}

/// Second derivatives of r times the force. With frames turned by exp(d): of an arm, r = R^T exp(-d) a, so that
/// f . r has the second-order part ((F . d)(d . a) - (F . a) d^2) / 2 - F . (d x a'), F = R f; of a turn, see below.
void PetioleRod::add_curvature(const Term& t, const glm::dvec3& force, double exactness, BlockMatrix& h) {
  const auto add = [&](int a, int b, const glm::dmat3& m) { h.add(h.slot(a, b), a, b, exactness * m); };
  if (!t.turn) {
    const int frame = t.node[2];
    const glm::dvec3 f = glm::transpose(t.derivative[1]) * force / t.share;
    add(frame, frame, 0.5 * (glm::outerProduct(f, t.arm) + glm::outerProduct(t.arm, f)) - glm::dmat3(glm::dot(f, t.arm)));
    add(t.node[0], frame, t.share * cross_matrix(f));
    add(t.node[1], frame, -t.share * cross_matrix(f));
  } else {
    // exp(-a) exp(b) = 1 - a + b - (a - b)^2 / 2 - a x b + ... with half the rotation vectors.
    const glm::dmat3 bend(0.5 * glm::dot(force, t.arm));
    const glm::dvec3 w = glm::transpose(t.derivative[1]) * force;
    add(t.node[0], t.node[0], -bend);
    add(t.node[1], t.node[1], -bend);
    add(t.node[0], t.node[1], bend + 0.5 * cross_matrix(w));
  }
}

double PetioleRod::assemble(const WiltShape& s, std::span<glm::dvec3> gradient, BlockMatrix& h, double exactness) const {
  double sum = 0;
  each_term(s, [&](const Term& t, std::size_t) {
    const glm::dvec3 force = t.stiffness * t.r;
    const glm::dmat3 k(t.stiffness.x, 0, 0, 0, t.stiffness.y, 0, 0, 0, t.stiffness.z);
    sum += 0.5 * glm::dot(force, t.r);
    for (int a = 0; a < t.count; ++a) {
      const glm::dmat3 da = glm::transpose(t.derivative[a]);
      gradient[std::size_t(t.node[a])] += da * force;
      for (int b = 0; b <= a; ++b) h.add(h.slot(t.node[a], t.node[b]), t.node[a], t.node[b], da * k * t.derivative[b]);
    }
    if (exactness > 0) add_curvature(t, force, exactness, h);
  });
  return sum;
}

void PetioleRod::preload(const WiltShape& rest, std::span<const glm::dvec3> u) {
  std::vector<glm::dvec3> change(preload_.size(), glm::dvec3(0.0));
  each_term(rest, [&](const Term& t, std::size_t number) {
    for (int a = 0; a < t.count; ++a) change[number] -= t.derivative[a] * u[std::size_t(t.node[a])];
  });
  for (std::size_t k = 0; k < change.size(); ++k) preload_[k] += change[k];
}

std::vector<double> PetioleRod::stress_MPa(const WiltShape& s) const {
  std::vector<double> stress(length_.size(), 0.0);
  const std::size_t n = length_.size();
  each_term(s, [&](const Term& t, std::size_t number) {
    if (number < n || number >= 2 * n - 1) return;
    const std::size_t k = number - n;  // between segments k and k + 1
    const double l = (length_[k] + length_[k + 1]) / 2;
    const double bend = std::hypot(t.r.x, t.r.y) / l * radius_m(int(k) + 1);
    for (const std::size_t q : {k, k + 1}) stress[q] = std::max(stress[q], modulus_[q] * bend * 1e-6);
  });
  return stress;
}

}  // namespace witherfield::leaf
