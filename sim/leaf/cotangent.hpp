// The cotangent operator of a triangle mesh with border. Shared by deformation, natural pose, water and wilting.
#pragma once
#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "sim/core/surface.hpp"
#include "sim/leaf/sparse.hpp"

namespace witherfield::leaf {

/// Triangles flatter than this (twice the area over the longest edge squared) get the weights of one that is just so
/// flat: their cotangents shrink all by the same factor, so that the matrix stays positive semi-definite.
inline constexpr double kFlattest = 1e-5;

/// cot of the angle at each corner of each triangle, always finite (see kFlattest; 0 when all corners coincide).
std::vector<std::array<double, 3>> corner_cotangents(std::span<const glm::dvec3> position_m,
                                                     std::span<const std::array<int, 3>> triangles);

/// L of Miao et al. (sec. 3): L_ij = -w_ij, L_ii = sum_j w_ij, w_ij = cot alpha_ij + cot beta_ij (border edges: one cot).
/// Symmetric, positive semi-definite, L 1 = 0, rank n - 1 for each connected piece; no unit; delta = L V in metres.
/// It is twice the stiffness matrix of linear finite elements: v^T L v / 2 = integral |grad v|^2, and
/// (L v)_i / (2 area_i) approximates -laplace v, that is 2 H n for v = position.
/// @param face_scale empty, or one factor > 0 per triangle on its three cotangents (a conductance, an anisotropy).
SparseMatrix cotangent_laplacian(std::span<const glm::dvec3> position_m, std::span<const std::array<int, 3>> triangles,
                                 std::span<const double> face_scale = {});
SparseMatrix cotangent_laplacian(const Surface& surface);

/// Lumped mass: a third of the area of the triangles around each vertex, m2. Sums to the surface's area.
std::vector<double> vertex_areas(std::span<const glm::dvec3> position_m, std::span<const std::array<int, 3>> triangles);

/// a L + diag(d): what implicit steps solve with. @pre d has one value per row.
SparseMatrix scaled_plus_diagonal(const SparseMatrix& l, double a, std::span<const double> d);

/// For each vertex the number of its connected piece (pieces numbered by their smallest vertex); vertices without a
/// triangle are pieces of their own. Returns the number of pieces.
int connected_pieces(std::size_t vertices, std::span<const std::array<int, 3>> triangles, std::vector<int>& piece);

}  // namespace witherfield::leaf
