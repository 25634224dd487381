// What differs within a piece of floor: growth rings and fibres of wood, clouds and veins of stone, speckles of vinyl.
#pragma once
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "pov/room_scene.hpp"

namespace witherfield::pov {

/// Smooth noise of mean 1/2 in 0..1, about one bump per unit, independent for every `seed`.
float soft_noise(glm::dvec2 at, std::uint32_t seed);
/// Sum of octaves, mean 1/2, in 0..1.
float cloud_noise(glm::dvec2 at, int octaves, std::uint32_t seed);

/// At one place of one piece.
struct Grain {
  glm::vec3 tint{1.0f};    ///< factor on the colour, mean about 1
  float fibre = 0.5f;      ///< 0..1, fine: where finish holds (1) or goes first (0)
  float pore = 0;          ///< 0..1: hollow that keeps dirt
  float relief_m = 0;      ///< unworn surface about its mean
  glm::dvec2 ragged_m{0.0};  ///< shift under which the worn fields are looked up
};
/// @param pixel_m width of a map pixel: finer detail is left out.
Grain grain_at(const FloorLook& look, const FloorPiece& piece, double pixel_m);

}  // namespace witherfield::pov
