// How tissue answers to its relative water content w (1 full turgor .. 0 dry): turgor, moduli, shrinkage.
#pragma once
#include "sim/leaf/wilt_options.hpp"

namespace witherfield::leaf {

/// P(w) = max(0, -pi_0 - epsilon (1 - w)) (loss point: Bartlett et al. 2012; taken as linear), MPa.
double turgor_MPa(const WiltTissueOptions& t, double water);
/// w below which there is none: 1 + pi_0 / epsilon (at least 0).
double turgor_loss_point(const WiltTissueOptions& t);
/// (P / P(1))^exponent, 0..1: what turgor adds to the stiffness.
double turgor_stiffening(const WiltTissueOptions& t, double water);

/// Below the turgor-loss point cells go on collapsing and parenchyma goes on softening (as potato pith does, Niklas 1988: 19 to 1.2 MPa from -0.4 to
/// -1.4 MPa water potential): factor on the limp moduli, 1 .. 0.2 (estimate). Without it a drying leaf would rise as it gets lighter.
double limp_softening(const WiltTissueOptions& t, double water);

double blade_bending_MPa(const WiltTissueOptions& t, double water);
double blade_membrane_MPa(const WiltTissueOptions& t, double water);
double vein_modulus_MPa(const WiltTissueOptions& t, double water);
double petiole_modulus_MPa(const WiltTissueOptions& t, double water);

double thickness_m(const WiltTissueOptions& t, double water);
/// Linear strain in the plane that the tissue would take on by itself. @param vein 0 blade .. 1 vein.
double shrink_strain(const WiltTissueOptions& t, double water, double vein);
/// Curvature that it would take on by itself, 1/m.
double shrink_curvature_1_m(const WiltTissueOptions& t, double water, double vein);

/// Rises smoothly from 0 to 1 over the lower half of the turgor: what stomata and the conductance of the tissue follow.
double turgor_share(const WiltTissueOptions& t, double water);

/// Transpiration per area over that with open stomata: stomata close with turgor, the cuticle goes on (and less from drier
/// tissue): [c + (1 - c) turgor_share] w / (w + 0.05) 1.05.
double transpiration_share(const WiltTissueOptions& t, double cuticular_share, double water);

}  // namespace witherfield::leaf
