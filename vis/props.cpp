#include "vis/props.hpp"

#include <fmt/format.h>
#include <vtkActor.h>
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
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <algorithm>
#include <cmath>

#include "sim/core/errors.hpp"
#include "sim/core/parallel.hpp"

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

/// The density that nine tenths of the filled voxels stay below: what counts as a full voxel in this file.
double full_density(vtkDataArray& density) {
  std::vector<float> filled;
  for (vtkIdType i = 0; i < density.GetNumberOfTuples(); ++i)
    if (const double d = density.GetComponent(i, 0); d > 0) filled.push_back(static_cast<float>(d));
  if (filled.empty()) return 1;
  const auto at = filled.begin() + static_cast<std::ptrdiff_t>(filled.size() * 9 / 10);
  std::nth_element(filled.begin(), at, filled.end());
  return *at;
}

// Density is stored in the alpha channel such that a full voxel has this level; denser ones up to 255 stay
// apart.
constexpr double kFullLevel = 160;

/// Colour and density in one array of bytes: half the memory of two floats, and labels are not blended into
/// others before they become colours.
vtkSmartPointer<vtkUnsignedCharArray> colour_and_density(vtkDataArray& field, vtkDataArray& density,
                                                         const Colouring& colouring) {
  auto out = vtkSmartPointer<vtkUnsignedCharArray>::New();
  out->SetName("colour and density");
  out->SetNumberOfComponents(4);
  out->SetNumberOfTuples(field.GetNumberOfTuples());
  unsigned char* rgba = out->GetPointer(0);
  const double scale = kFullLevel / 255 / full_density(density);
  // Most of the volume is air: one colour computed once.
  unsigned char air[4] = {};
  const double zero[9] = {};
  const glm::dvec3 colour = colouring.at(zero, std::min(field.GetNumberOfComponents(), 9));
  for (int c = 0; c < 3; ++c) air[c] = level(colour[c]);
  parallel_for(static_cast<std::size_t>(field.GetNumberOfTuples()), 65536,
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t v = begin; v < end; ++v) {
                   const auto i = static_cast<vtkIdType>(v);
                   bool any = false;
                   for (int c = 0; c < field.GetNumberOfComponents(); ++c)
                     any |= field.GetComponent(i, c) != 0;
                   std::copy_n(air, 4, rgba + 4 * v);
                   if (any) put_colour(field, i, colouring, rgba + 4 * v);
                   if (const double d = density.GetComponent(i, 0); d > 0)
                     rgba[4 * v + 3] = std::max<unsigned char>(1, level(d * scale));
                 }
               });
  return out;
}

void set_material(vtkActor& actor) {
  vtkProperty* p = actor.GetProperty();
  p->SetAmbient(0.35);
  p->SetDiffuse(0.7);
  p->SetSpecular(0.0);
}

}  // namespace

Prop volume_prop(vtkDataSet& image, vtkDataArray& field, vtkDataArray& density, const Colouring& colouring) {
  auto* source = vtkImageData::SafeDownCast(&image);
  vtkNew<vtkImageData> baked;
  baked->CopyStructure(source);
  baked->GetPointData()->SetScalars(colour_and_density(field, density, colouring));
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
  opacity->AddPoint(0.08 * kFullLevel, 0);
  opacity->AddPoint(0.55 * kFullLevel, 0.88);
  opacity->AddPoint(255, 0.97);
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
  vtkNew<vtkImageData> input;
  input->CopyStructure(source);
  input->GetPointData()->SetScalars(&density);
  if (&field != &density) input->GetPointData()->AddArray(&field);
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(input);
  contour->SetValue(0, iso);
  contour->ComputeNormalsOn();
  contour->InterpolateAttributesOn();
  contour->Update();
  vtkPolyData* surface = contour->GetOutput();
  if (surface->GetNumberOfPoints() == 0) {
    double range[2];
    density.GetRange(range);
    throw InvalidInput(fmt::format("no surface: density is within [{:.4g}, {:.4g}], the iso value is {}",
                                   range[0], range[1], iso));
  }
  vtkSmartPointer<vtkDataArray> values = surface->GetPointData()->GetArray(field.GetName());
  if (!values || colouring.is_label()) {
    values = vtkSmartPointer<vtkDataArray>::Take(field.NewInstance());
    values->SetNumberOfComponents(field.GetNumberOfComponents());
    values->SetNumberOfTuples(surface->GetNumberOfPoints());
    for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i) {
      double p[3];
      surface->GetPoint(i, p);
      values->SetTuple(i, std::max<vtkIdType>(0, source->FindPoint(p)), &field);
    }
  }
  surface->GetPointData()->SetScalars(colours(*values, colouring));
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(surface);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  set_material(*actor);
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
