#include "vis/props.hpp"

#include <fmt/format.h>
#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkColorTransferFunction.h>
#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkGPUVolumeRayCastMapper.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkPointGaussianMapper.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkSmartPointer.h>
#include <vtkTexture.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <span>
#include <vector>

#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"
#include "vis/reconstruct.hpp"

namespace witherfield::vis {
namespace {

Prop shared(vtkProp3D* prop) {
  prop->Register(nullptr);
  return {prop, [](vtkProp3D* p) { p->Delete(); }};
}

unsigned char level(double x) {
  return static_cast<unsigned char>(std::lround(std::clamp(x, 0.0, 1.0) * 255));
}

void put_colour(vtkDataArray& values, vtkIdType i, const Colouring& colouring, unsigned char* rgb) {
  double tuple[9] = {};
  const int components = std::min(values.GetNumberOfComponents(), 9);
  for (int c = 0; c < components; ++c) tuple[c] = values.GetComponent(i, c);
  const glm::dvec3 colour = colouring.at(tuple, components);
  for (int c = 0; c < 3; ++c) rgb[c] = level(colour[c]);
}

/// RGB of every tuple.
vtkSmartPointer<vtkUnsignedCharArray> colours(vtkDataArray& values, const Colouring& colouring) {
  auto out = vtkSmartPointer<vtkUnsignedCharArray>::New();
  out->SetName("colour");
  out->SetNumberOfComponents(3);
  out->SetNumberOfTuples(values.GetNumberOfTuples());
  unsigned char* rgb = out->GetPointer(0);
  parallel_for(static_cast<std::size_t>(values.GetNumberOfTuples()), 4096,
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t i = begin; i < end; ++i)
                   put_colour(values, static_cast<vtkIdType>(i), colouring, rgb + 3 * i);
               });
  return out;
}

/// An image's array as floats (a copy only where it is not).
class Floats {
 public:
  Floats(vtkImageData& image, vtkDataArray& array) {
    image.GetDimensions(view_.size.data());
    view_.components = array.GetNumberOfComponents();
    const auto count = static_cast<std::size_t>(array.GetNumberOfValues());
    if (auto* floats = vtkFloatArray::FastDownCast(&array)) {
      view_.values = {floats->GetPointer(0), count};
      return;
    }
    copy_.resize(count);
    for (std::size_t n = 0; n < count; ++n)
      copy_[n] = static_cast<float>(array.GetComponent(static_cast<vtkIdType>(n) / view_.components,
                                                       static_cast<int>(n) % view_.components));
    view_.values = copy_;
  }
  const ImageValues& view() const { return view_; }

 private:
  ImageValues view_;
  std::vector<float> copy_;
};

/// Median of the spline at the filled voxels: what counts as a full voxel in this file.
double full_level(std::span<const float> density, std::span<const float> spline) {
  std::vector<float> filled;
  for (std::size_t n = 0; n < density.size(); ++n)
    if (density[n] > 0) filled.push_back(spline[n]);
  if (filled.empty()) return 1;
  const auto at = filled.begin() + static_cast<std::ptrdiff_t>(filled.size() / 2);
  std::nth_element(filled.begin(), at, filled.end());
  return *at;
}

// Density is stored in the alpha channel such that a full voxel has this level; denser ones up to 255 stay
// apart.
constexpr double kFullLevel = 110;

/// Colour and density in one array of bytes: a quarter of the memory of floats, and labels are not blended
/// into others before they become colours. The shading is mild, so that the colour bar stays true.
class Baker {
 public:
  Baker(const ImageValues& field, std::span<const float> density, const Colouring& colouring,
        const glm::dvec3& to_light)
      : field_(field), density_(density), colouring_(colouring), to_light_(to_light) {
    spline_ = spline_at_voxels({field.size, 1, density});
    scale_ = kFullLevel / 255 / full_level(density, spline_);
  }

  vtkSmartPointer<vtkUnsignedCharArray> bake() const {
    auto out = vtkSmartPointer<vtkUnsignedCharArray>::New();
    out->SetName("colour and density");
    out->SetNumberOfComponents(4);
    out->SetNumberOfTuples(static_cast<vtkIdType>(density_.size()));
    unsigned char* rgba = out->GetPointer(0);
    parallel_for(static_cast<std::size_t>(field_.size[2]), 1, [&](std::size_t begin, std::size_t end) {
      for (int k = static_cast<int>(begin); k < static_cast<int>(end); ++k)
        for (int j = 0; j < field_.size[1]; ++j)
          for (int i = 0; i < field_.size[0]; ++i) voxel({i, j, k}, rgba + 4 * field_.index(i, j, k));
    });
    return out;
  }

 private:
  float spline(int i, int j, int k) const {
    if (i < 0 || j < 0 || k < 0 || i >= field_.size[0] || j >= field_.size[1] || k >= field_.size[2])
      return 0;
    return spline_[field_.index(i, j, k)];
  }

  void voxel(const glm::ivec3& v, unsigned char* rgba) const {
    std::fill_n(rgba, 4, static_cast<unsigned char>(0));
    // Colour is needed wherever a neighbour is visible, or interpolation would darken the rims.
    const glm::dvec3 gradient{spline(v.x + 1, v.y, v.z) - spline(v.x - 1, v.y, v.z),
                              spline(v.x, v.y + 1, v.z) - spline(v.x, v.y - 1, v.z),
                              spline(v.x, v.y, v.z + 1) - spline(v.x, v.y, v.z - 1)};
    const float own = spline(v.x, v.y, v.z);
    const double slope = glm::length(gradient);
    if (!(own > 0) && !(slope > 0)) return;
    double tuple[9] = {};
    value_near(field_, density_, v, colouring_.is_label(), tuple);
    const double facing = slope > 0 ? -glm::dot(gradient, to_light_) / slope : 0.0;
    const glm::dvec3 colour = colouring_.at(tuple, field_.components) * (0.93 + 0.13 * facing);
    for (int c = 0; c < 3; ++c) rgba[c] = level(colour[c]);
    if (own > 0) rgba[3] = std::max<unsigned char>(1, level(own * scale_));
  }

  const ImageValues field_;
  const std::span<const float> density_;
  const Colouring& colouring_;
  const glm::dvec3 to_light_;
  std::vector<float> spline_;
  double scale_ = 1;
};

vtkSmartPointer<vtkUnsignedCharArray> surface_colours(vtkPolyData& surface, vtkImageData& image,
                                                      const ImageValues& field,
                                                      std::span<const float> density,
                                                      const Colouring& colouring) {
  auto out = vtkSmartPointer<vtkUnsignedCharArray>::New();
  out->SetName("colour");
  out->SetNumberOfComponents(3);
  out->SetNumberOfTuples(surface.GetNumberOfPoints());
  unsigned char* rgb = out->GetPointer(0);
  double origin[3], spacing[3];
  image.GetOrigin(origin);
  image.GetSpacing(spacing);
  parallel_for(static_cast<std::size_t>(surface.GetNumberOfPoints()), 1024,
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t n = begin; n < end; ++n) {
                   double p[3], tuple[9] = {};
                   surface.GetPoint(static_cast<vtkIdType>(n), p);
                   const glm::dvec3 at{(p[0] - origin[0]) / spacing[0], (p[1] - origin[1]) / spacing[1],
                                       (p[2] - origin[2]) / spacing[2]};
                   value_near(field, density, at, colouring.is_label(), tuple);
                   const glm::dvec3 colour = colouring.at(tuple, field.components);
                   for (int c = 0; c < 3; ++c) rgb[3 * n + std::size_t(c)] = level(colour[c]);
                 }
               });
  return out;
}

// A flat sheet halfway between two layers of voxels has half of its density in each, which makes the spline's
// value there 1/2 * 4/6 + 1/2 * 1/6 of the sheet's: the least that it has wherever the sheet lies.
constexpr double kSheet = 5.0 / 12;

void set_material(vtkActor& actor) {
  vtkProperty* p = actor.GetProperty();
  p->SetAmbient(0.42);
  p->SetDiffuse(0.68);
  p->SetSpecular(0.0);
}

}  // namespace

Prop volume_prop(vtkDataSet& image, vtkDataArray& field, vtkDataArray& density, const Colouring& colouring,
                 const glm::dvec3& to_light) {
  auto* source = vtkImageData::SafeDownCast(&image);
  const Floats field_values(*source, field), density_values(*source, density);
  vtkNew<vtkImageData> baked;
  baked->CopyStructure(source);
  baked->GetPointData()->SetScalars(
      Baker(field_values.view(), density_values.view().values, colouring, to_light).bake());
  const double spacing = source->GetSpacing()[0];

  vtkNew<vtkGPUVolumeRayCastMapper> mapper;
  mapper->SetInputData(baked);
  mapper->AutoAdjustSampleDistancesOff();
  mapper->SetSampleDistance(static_cast<float>(spacing * 0.5));
  mapper->UseJitteringOn();

  vtkNew<vtkVolume> volume;
  volume->SetMapper(mapper);
  vtkVolumeProperty* p = volume->GetProperty();
  p->IndependentComponentsOff();  // the colour is the data; opacity from the fourth component
  p->SetInterpolationTypeToLinear();
  vtkNew<vtkPiecewiseFunction> opacity;
  opacity->AddPoint(0, 0);
  opacity->AddPoint(0.15 * kFullLevel, 0);
  opacity->AddPoint(0.75 * kFullLevel, 0.9);
  opacity->AddPoint(1.5 * kFullLevel, 0.98);
  opacity->AddPoint(255, 0.98);
  vtkNew<vtkColorTransferFunction> unused;  // the mapper asks for one even where colours are direct
  unused->AddRGBPoint(0, 0, 0, 0);
  unused->AddRGBPoint(255, 1, 1, 1);
  p->SetColor(unused);
  p->SetScalarOpacity(opacity);
  // VTK 9.1 takes the unit distance of the last component, not of the first, which is all that the
  // one-argument setter sets; with the default of 1 a volume in small units would be invisible.
  for (int component = 0; component < 4; ++component) p->SetScalarOpacityUnitDistance(component, spacing);
  return shared(volume);
}

Prop surface_prop(vtkDataSet& image, vtkDataArray& field, vtkDataArray& density, double iso,
                  const Colouring& colouring) {
  auto* source = vtkImageData::SafeDownCast(&image);
  const Floats field_values(*source, field), density_values(*source, density);
  std::vector<float> spline = spline_at_voxels(density_values.view());
  vtkNew<vtkFloatArray> scalars;
  scalars->SetName("spline");
  scalars->SetArray(spline.data(), static_cast<vtkIdType>(spline.size()), 1);  // stays ours
  vtkNew<vtkImageData> input;
  input->CopyStructure(source);
  input->GetPointData()->SetScalars(scalars);
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(input);
  contour->SetValue(0, iso * kSheet);
  contour->ComputeNormalsOn();
  contour->Update();
  vtkPolyData* surface = contour->GetOutput();
  if (surface->GetNumberOfPoints() == 0)
    throw InvalidInput(fmt::format("no surface: density stays below {:.4g}, the iso value is {}",
                                   *std::max_element(spline.begin(), spline.end()) / kSheet, iso));
  surface->GetPointData()->SetScalars(
      surface_colours(*surface, *source, field_values.view(), density_values.view().values, colouring));
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(surface);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  set_material(*actor);
  return shared(actor);
}

Prop sheet_prop(vtkDataSet& image, vtkDataArray& field, bool of_cells, const Colouring& colouring) {
  auto* source = vtkImageData::SafeDownCast(&image);
  std::array<int, 3> size;
  source->GetDimensions(size.data());
  if (of_cells)
    for (int& n : size) n = std::max(1, n - 1);
  vtkNew<vtkImageData> texels;
  texels->SetDimensions(size.data());
  texels->GetPointData()->SetScalars(colours(field, colouring));
  std::array<double, 6> b;
  source->GetBounds(b.data());
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> place;
  place->SetNumberOfComponents(2);
  for (const auto& [u, v] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
    points->InsertNextPoint(b[std::size_t(u)], b[std::size_t(2 + v)], b[4]);
    place->InsertNextTuple2(u, v);
  }
  vtkNew<vtkCellArray> cells;
  const vtkIdType corners[] = {0, 1, 2, 3};
  cells->InsertNextCell(4, corners);
  vtkNew<vtkPolyData> quad;
  quad->SetPoints(points);
  quad->SetPolys(cells);
  quad->GetPointData()->SetTCoords(place);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(quad);
  vtkNew<vtkTexture> texture;
  texture->SetInputData(texels);
  texture->SetColorModeToDirectScalars();
  texture->SetWrap(vtkTexture::ClampToEdge);
  texture->MipmapOn();
  if (!colouring.is_label()) texture->InterpolateOn();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->SetTexture(texture);
  actor->GetProperty()->LightingOff();
  return shared(actor);
}

Prop poly_prop(vtkDataSet& poly, vtkDataArray& field, bool of_cells, double sphere_radius,
               const Colouring& colouring) {
  auto* source = vtkPolyData::SafeDownCast(&poly);
  vtkNew<vtkPolyData> data;
  data->CopyStructure(source);
  const vtkSmartPointer<vtkUnsignedCharArray> rgb = colours(field, colouring);
  if (of_cells)
    data->GetCellData()->SetScalars(rgb);
  else
    data->GetPointData()->SetScalars(rgb);
  vtkNew<vtkActor> actor;
  if (data->GetNumberOfPolys() + data->GetNumberOfStrips() == 0) {
    vtkNew<vtkPointGaussianMapper> mapper;
    mapper->SetInputData(data);
    mapper->SetScaleFactor(sphere_radius);
    mapper->EmissiveOff();
    // A disc shaded like a ball that is lit from the eye.
    mapper->SetSplatShaderCode(
        "//VTK::Color::Impl\n"
        "float r2 = dot(offsetVCVSOutput.xy, offsetVCVSOutput.xy);\n"
        "if (r2 > 1.0) { discard; }\n"
        "float lit = 0.55 + 0.45 * sqrt(1.0 - r2);\n"
        "ambientColor *= lit; diffuseColor *= lit;\n");
    mapper->SetTriangleScale(1.5);
    actor->SetMapper(mapper);
  } else {
    vtkNew<vtkPolyDataNormals> normals;
    normals->SetInputData(data);
    normals->SplittingOff();
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(normals->GetOutputPort());
    actor->SetMapper(mapper);
  }
  set_material(*actor);
  return shared(actor);
}

}  // namespace witherfield::vis
