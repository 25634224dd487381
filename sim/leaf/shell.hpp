// A thin elastic shell of triangles with ribs, for large displacements and rotations and small strains.
//
// Membrane: linear triangles, Green strain against a rest shape that the tissue's shrinkage makes smaller (eigenstrain).
// Bending: curvature of a triangle from the angles of its three hinges, kappa = sum_i angle_i h_i grad_i (x) grad_i (Grinspun
// et al. 2006, discrete shape operator), with the energy of an isotropic plate; exact for every quadratic shape on regular meshes.
// A hinge that is missing at the margin takes the angle that costs least: no moment across a free edge.
// Ribs stretch, bend and twist with the triangle in which they lie.
#pragma once
#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

#include "sim/leaf/block_matrix.hpp"
#include "sim/leaf/sheet_law.hpp"
#include "sim/leaf/shell_patch.hpp"
#include "sim/leaf/vein_ribs.hpp"

namespace witherfield::leaf {

/// Of one triangle at one moment.
struct ShellMaterial {
  double membrane_Pa = 0;      ///< modulus in the plane
  double bending_Pa = 0;       ///< modulus in bending
  double thickness_m = 0;
  double poisson = 0;
  double shrink_strain = 0;    ///< linear eigenstrain
  double curvature_1_m = 0;    ///< eigencurvature, > 0 towards the upper side
  double rib_Pa = 0;           ///< modulus of the ribs in it, in bending and torsion
  double compression = 1;      ///< share of the stiffness in the plane against compression (sheet_law.hpp)
  double rib_axial_Pa = 0;     ///< modulus of the ribs along themselves
  double rib_shrink_strain = 0;  ///< their own linear eigenstrain
};

class Shell {
 public:
  Shell(std::vector<ShellPatch> patches, std::vector<RibPiece> ribs);

  /// @pre one per triangle.
  void set_material(std::span<const ShellMaterial> material);
  /// Pairs of vertices that the energy couples.
  std::vector<std::pair<int, int>> couplings() const;
  /// Looks up the places in `h` once; `assemble` then adds there.
  void bind(const BlockMatrix& h);

  /// Joule. @param x positions of all nodes, the shell's vertices first.
  double energy(std::span<const glm::dvec3> x) const;
  /// Adds the gradient and the second derivatives; gives the energy.
  /// @param exactness 1: exact, indefinite where the sheet is about to buckle; 0: compression and the change of the hinges'
  /// directions left out, positive semi-definite; between: mixed.
  double assemble(std::span<const glm::dvec3> x, std::span<glm::dvec3> gradient, BlockMatrix& h, double exactness) const;

  /// Makes the rest shape one under load: strains and angles at rest become those of the small displacement `u`, so that the
  /// gradient at rest is K u. @pre the material is the one at rest (no eigenstrain).
  void preload(std::span<const glm::dvec3> rest_m, std::span<const glm::dvec3> u);

  /// Largest von Mises stress of both faces of each triangle, MPa.
  std::vector<double> von_mises_MPa(std::span<const glm::dvec3> x) const;
  const std::vector<ShellPatch>& patches() const { return patches_; }

 private:
  struct Stiffness {
    double sheet;         ///< N m: E h area / (1 - nu^2)
    double poisson, compression;
    glm::dmat3 ribs;      ///< N m per strain^2, (11, 22, 2x12)
    glm::dmat3 bending;   ///< N m per angle^2 over the three hinges, ribs included
    double scale, rib_scale;  ///< 1 / (1 + shrink)^2 of the sheet, of its ribs
    std::array<double, 3> angle;  ///< that the eigencurvature would make
  };
  struct Strain {
    glm::dvec3 f1, f2;    ///< columns of the deformation gradient
    glm::dvec3 strain, rib_strain;  ///< (11, 22, 2x12)
    glm::dvec3 angle;     ///< of the hinges, less those at rest
  };
  Strain measure(std::size_t t, std::span<const glm::dvec3> x) const;
  /// Of the sheet and its ribs; derivatives after F^T F / 2.
  SheetResponse membrane(std::size_t t, const Strain& strain) const;
  Stiffness stiffness(std::size_t t, const ShellMaterial& m) const;
  struct Local {  ///< contribution of one triangle over its six nodes; second derivatives: lower triangle by rows
    double energy;
    std::array<glm::dvec3, 6> gradient;
    std::array<glm::dmat3, 21> hessian;
  };
  void element(std::size_t t, std::span<const glm::dvec3> x, double exactness, Local& out) const;

  std::vector<ShellPatch> patches_;
  std::vector<RibPiece> ribs_;
  std::vector<int> rib_start_;
  std::vector<ShellMaterial> material_;
  std::vector<Stiffness> stiffness_;
  std::vector<glm::dvec3> preload_strain_, preload_angle_;
  std::vector<std::array<int, 21>> slot_;
  mutable std::vector<Local> local_;  ///< kept: making it anew for each assembly costs more than filling it
};

}  // namespace witherfield::leaf
