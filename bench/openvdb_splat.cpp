#include "bench/openvdb_splat.hpp"

#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace witherfield::bench {
namespace {

using openvdb::Coord;
using openvdb::FloatTree;
using openvdb::Int32Tree;
using openvdb::Vec3s;
using openvdb::Vec3STree;

enum Scalar { kWeight, kWater, kChlorophyll, kStressVein, kStressMesophyll, kStrain, kSpecular, kScalars };
enum Vector { kColour, kTangentA, kTangentB, kNormalA, kNormalB, kVectors };

/// Weights of one axis, with sum `scale`, from voxel `lo` on.
struct Axis {
  int lo;
  std::vector<float> weights;

  void set(double x, int n, double sigma, double scale) {
    const int own = int(x), reach = std::max(1, int(std::ceil(2 * sigma)));
    lo = std::max(own - reach, 0);
    const int hi = std::min(own + reach, n - 1);
    double w[32], sum = 0;
    for (int v = lo; v <= hi; ++v) {
      const double d = v + 0.5 - x;
      sum += w[v - lo] = std::exp(-d * d / (2 * sigma * sigma));
    }
    weights.resize(std::size_t(hi - lo + 1));
    for (std::size_t v = 0; v < weights.size(); ++v) weights[v] = float(w[v] * scale / sum);
  }
};

}  // namespace

struct OpenvdbSplat::Impl {
  std::vector<FloatTree> scalars = std::vector<FloatTree>(kScalars);
  std::vector<Vec3STree> vectors = std::vector<Vec3STree>(kVectors);
  FloatTree heaviest_weight;
  Int32Tree heaviest;

  void scatter(const PointSet& points, const ScatterGrid& grid, double sigma);
};

void OpenvdbSplat::Impl::scatter(const PointSet& p, const ScatterGrid& grid, double sigma) {
  using Scalars = openvdb::tree::ValueAccessor<FloatTree>;
  using Vectors = openvdb::tree::ValueAccessor<Vec3STree>;
  std::vector<Scalars> scalar;
  std::vector<Vectors> vector;
  scalar.reserve(kScalars), vector.reserve(kVectors);
  for (FloatTree& tree : scalars) scalar.emplace_back(tree);
  for (Vec3STree& tree : vectors) vector.emplace_back(tree);
  Scalars best(heaviest_weight);
  openvdb::tree::ValueAccessor<Int32Tree> leader(heaviest);

  Axis x, y, z;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const glm::dvec3 at = (p.position_m[i] - grid.origin_m) / grid.spacing_m;
    x.set(at.x, grid.nx, sigma, 1), y.set(at.y, grid.ny, sigma, 1);
    z.set(at.z, grid.nz, sigma, p.mass_kg[i] / p.point_mass_kg);
    const float s[kScalars] = {1,
                               p.water[i],
                               p.chlorophyll_ug_cm2[i],
                               p.stress_vein_MPa[i],
                               p.stress_mesophyll_MPa[i],
                               p.strain_shrink[i],
                               p.specular[i]};
    const glm::vec3 t = p.tangent[i], n = p.normal[i], c = p.diffuse[i];
    const Vec3s v[kVectors] = {Vec3s(c.x, c.y, c.z), Vec3s(t.x * t.x, t.x * t.y, t.x * t.z),
                               Vec3s(t.y * t.y, t.y * t.z, t.z * t.z), Vec3s(n.x * n.x, n.x * n.y, n.x * n.z),
                               Vec3s(n.y * n.y, n.y * n.z, n.z * n.z)};
    Coord voxel;
    // z innermost: the order in which OpenVDB's leaves store their voxels.
    for (std::size_t a = 0; a < x.weights.size(); ++a)
      for (std::size_t b = 0; b < y.weights.size(); ++b)
        for (std::size_t d = 0; d < z.weights.size(); ++d) {
          voxel.reset(x.lo + int(a), y.lo + int(b), z.lo + int(d));
          const float w = x.weights[a] * y.weights[b] * z.weights[d];
          for (int k = 0; k < kScalars; ++k)
            scalar[std::size_t(k)].modifyValue(voxel, [&](float& sum) { sum += w * s[k]; });
          for (int k = 0; k < kVectors; ++k)
            vector[std::size_t(k)].modifyValue(voxel, [&](Vec3s& sum) { sum += w * v[k]; });
          bool heavier = false;
          best.modifyValue(voxel, [&](float& most) {
            heavier = w > most;
            if (heavier) most = w;
          });
          if (heavier) leader.setValue(voxel, std::int32_t(i));
        }
  }
}

OpenvdbSplat::OpenvdbSplat(const PointSet& points, const ScatterGrid& grid, double sigma_voxels)
    : impl_(std::make_unique<Impl>()) {
  impl_->scatter(points, grid, sigma_voxels);
}

OpenvdbSplat::~OpenvdbSplat() = default;

double OpenvdbSplat::weight(int i, int j, int k) const {
  return impl_->scalars[kWeight].getValue({i, j, k});
}

std::size_t OpenvdbSplat::voxels() const {
  return std::size_t(impl_->scalars[kWeight].activeVoxelCount());
}

}  // namespace witherfield::bench
