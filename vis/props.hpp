// Data sets as things to draw.
#pragma once
#include <memory>

#include "vis/colouring.hpp"

class vtkProp3D;

namespace witherfield::vis {

using Prop = std::shared_ptr<vtkProp3D>;

/// A volume of the image: colour from `field`, opacity from `density` (both point arrays of the image),
/// slightly shaded by a light from `to_light`.
Prop volume_prop(vtkDataSet& image, vtkDataArray& field, vtkDataArray& density, const Colouring& colouring,
                 const glm::dvec3& to_light);

/// The surface density = iso, coloured by `field`. @throws InvalidInput when density does not reach iso
/// anywhere.
Prop surface_prop(vtkDataSet& image, vtkDataArray& field, vtkDataArray& density, double iso,
                  const Colouring& colouring);

/// An image one cell or point thick, lying in its plane z, every cell in the colour of its value, unshaded.
Prop sheet_prop(vtkDataSet& image, vtkDataArray& field, bool of_cells, const Colouring& colouring);

/// Triangles, or spheres at the points of a file without any. `field` belongs to the points or to the cells.
Prop poly_prop(vtkDataSet& poly, vtkDataArray& field, bool of_cells, double sphere_radius,
               const Colouring& colouring);

}  // namespace witherfield::vis
