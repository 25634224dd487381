#include "vis/edit_surface.hpp"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>
#include <vtkTexture.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

#include "sim/core/colour.hpp"
#include "sim/core/errors.hpp"

namespace witherfield::vis {
namespace {

// The light of the editor: a warm one from the upper left, a cool one from the right, both fixed to the eye, on either side of
// the sheet. It stands in for VTK's own light, which takes powers for each light and pixel: half of a frame where a processor
// draws. Both sides are lit: the normal is turned to the eye.
constexpr const char* kLight =
    "  vec3 n = normalVCVSOutput.z < 0.0 ? -normalVCVSOutput : normalVCVSOutput;\n"
    "  float key = max(dot(n, vec3(-0.406, 0.628, 0.664)), 0.0);\n"
    "  float fill = max(dot(n, vec3(0.786, -0.087, 0.612)), 0.0);\n"
    "  float gloss = key * key; gloss *= gloss; gloss *= gloss;\n"
    "  vec3 light = vec3(0.30) + key * vec3(0.76, 0.74, 0.70) + fill * vec3(0.24, 0.26, 0.29);\n"
    "  gl_FragData[0] = vec4(diffuseColor * light + 0.06 * gloss, opacity);\n";
// Seen from below a leaf is paler and greyer than from above (spongy tissue scatters).
constexpr const char* kUnderside =
    "//VTK::TCoord::Impl\n"
    "  if (!gl_FrontFacing) {\n"
    "    float grey = dot(gl_FragData[0].rgb, vec3(0.30, 0.59, 0.11));\n"
    "    gl_FragData[0].rgb = mix(gl_FragData[0].rgb, vec3(0.06) + grey * vec3(1.02, 1.08, 0.92), 0.45);\n"
    "  }\n";

unsigned char level(double encoded) { return static_cast<unsigned char>(std::lround(std::clamp(encoded, 0.0, 1.0) * 255)); }

}  // namespace

struct EditSurface::Impl {
  std::vector<glm::dvec3> position;
  std::vector<std::array<int, 3>> triangles;
  std::vector<glm::vec3> own_colour;  ///< encoded; empty when a picture colours the surface
  vtkNew<vtkPolyData> data;
  vtkNew<vtkFloatArray> coordinates, normals;
  vtkNew<vtkUnsignedCharArray> colours;
  vtkNew<vtkPolyDataMapper> mapper;
  vtkNew<vtkActor> actor;
  vtkNew<vtkTexture> texture;
  bool has_picture = false, by_field = false;
  SurfaceStyle style = SurfaceStyle::smooth;

  /// Area-weighted normals in single precision: the screen needs no more, and it is done in each frame.
  void upload() {
    const std::size_t n = position.size();
    float* p = coordinates->GetPointer(0);
    for (std::size_t i = 0; i < n; ++i)
      for (int c = 0; c < 3; ++c) p[3 * i + std::size_t(c)] = float(position[i][c]);
    auto* normal = reinterpret_cast<glm::vec3*>(normals->GetPointer(0));
    std::fill(normal, normal + n, glm::vec3(0.0f));
    for (const auto& t : triangles) {
      const glm::dvec3& a = position[std::size_t(t[0])];
      const glm::vec3 area(glm::cross(position[std::size_t(t[1])] - a, position[std::size_t(t[2])] - a) * 1e6);
      for (const int v : t) normal[v] += area;
    }
    for (std::size_t i = 0; i < n; ++i) {
      const float length = glm::length(normal[i]);
      normal[i] = length > 0 ? normal[i] / length : glm::vec3(0, 0, 1);
    }
    coordinates->Modified();
    normals->Modified();
    data->GetPoints()->Modified();
    data->Modified();
  }

  void apply_colours() {
    const bool textured = has_picture && !by_field;
    mapper->SetScalarVisibility(!textured);
    actor->SetTexture(textured ? texture.Get() : nullptr);
    colours->Modified();
    data->Modified();
  }
};

EditSurface::EditSurface(vtkRenderer& renderer) : impl_(std::make_unique<Impl>()) {
  Impl& m = *impl_;
  m.coordinates->SetNumberOfComponents(3);
  m.normals->SetNumberOfComponents(3);
  m.normals->SetName("Normals");
  m.colours->SetNumberOfComponents(3);
  m.colours->SetName("colour");
  m.mapper->SetInputData(m.data);
  m.mapper->SetColorModeToDirectScalars();
  m.actor->SetMapper(m.mapper);
  vtkProperty* p = m.actor->GetProperty();
  p->SetAmbient(0);
  p->SetDiffuse(1);
  p->SetSpecular(0);
  p->SetEdgeColor(0.07, 0.15, 0.09);
  p->SetLineWidth(1);
  m.actor->GetShaderProperty()->AddFragmentShaderReplacement("//VTK::Light::Impl", true, kLight, true);
  m.actor->GetShaderProperty()->AddFragmentShaderReplacement("//VTK::TCoord::Impl", true, kUnderside, false);
  m.texture->InterpolateOn();
  m.texture->RepeatOff();
  m.texture->EdgeClampOn();
  m.actor->VisibilityOff();
  renderer.AddActor(m.actor);
}

EditSurface::~EditSurface() = default;

void EditSurface::show(const Surface& surface, const SurfacePicture& picture) {
  Impl& m = *impl_;
  m.position = surface.position_m;
  m.triangles = surface.triangles;
  const auto n = static_cast<vtkIdType>(m.position.size());
  m.coordinates->SetNumberOfTuples(n);
  m.normals->SetNumberOfTuples(n);
  vtkNew<vtkPoints> points;
  points->SetData(m.coordinates);
  vtkNew<vtkCellArray> cells;
  cells->AllocateExact(static_cast<vtkIdType>(m.triangles.size()), static_cast<vtkIdType>(3 * m.triangles.size()));
  for (const auto& t : m.triangles) {
    const vtkIdType corners[] = {t[0], t[1], t[2]};
    cells->InsertNextCell(3, corners);
  }
  m.data->Initialize();
  m.data->SetPoints(points);
  m.data->SetPolys(cells);
  m.data->GetPointData()->SetNormals(m.normals);
  m.data->GetPointData()->SetScalars(m.colours);
  m.has_picture = picture.width > 0 && surface.uv.size() == surface.position_m.size();
  if (m.has_picture) {
    vtkNew<vtkFloatArray> uv;
    uv->SetNumberOfComponents(2);
    uv->SetName("uv");
    uv->SetNumberOfTuples(n);
    for (vtkIdType i = 0; i < n; ++i) uv->SetTuple2(i, surface.uv[std::size_t(i)].x, surface.uv[std::size_t(i)].y);
    m.data->GetPointData()->SetTCoords(uv);
    vtkNew<vtkImageData> image;
    image->SetDimensions(picture.width, picture.height, 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    std::memcpy(image->GetScalarPointer(), picture.rgb.data(), picture.rgb.size());
    m.texture->SetInputData(image);
  }
  m.own_colour.assign(m.position.size(), glm::vec3(0.45f, 0.55f, 0.38f));
  if (surface.has_field("diffuse")) {
    const auto& values = surface.field("diffuse").values;
    for (std::size_t i = 0; i < m.own_colour.size(); ++i)
      for (int c = 0; c < 3; ++c) m.own_colour[i][c] = float(srgb_encode(double(values[3 * i + std::size_t(c)])));
  }
  m.colours->SetNumberOfTuples(n);
  m.upload();
  colour_by_itself();
  m.actor->SetVisibility(!m.triangles.empty());
  set_style(m.style);
}

void EditSurface::move(std::span<const glm::dvec3> position) {
  if (position.size() != impl_->position.size())
    throw InvalidInput("edit window: " + std::to_string(position.size()) + " positions for a surface of " +
                       std::to_string(impl_->position.size()) + " vertices");
  impl_->position.assign(position.begin(), position.end());
  impl_->upload();
}

void EditSurface::set_style(SurfaceStyle style) {
  Impl& m = *impl_;
  m.style = style;
  vtkProperty* p = m.actor->GetProperty();
  p->SetEdgeVisibility(style == SurfaceStyle::edges);
  if (style == SurfaceStyle::wireframe)
    p->SetRepresentationToWireframe();
  else
    p->SetRepresentationToSurface();
}

void EditSurface::colour_by(std::span<const float> values, const ColourMap& map) {
  Impl& m = *impl_;
  if (values.size() != m.position.size())
    throw InvalidInput("edit window: " + std::to_string(values.size()) + " values for a surface of " +
                       std::to_string(m.position.size()) + " vertices");
  unsigned char* to = m.colours->GetPointer(0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const glm::dvec3 c = map.at(double(values[i]));
    for (int k = 0; k < 3; ++k) to[3 * i + std::size_t(k)] = level(c[k]);
  }
  m.by_field = true;
  m.apply_colours();
}

void EditSurface::colour_by_itself() {
  Impl& m = *impl_;
  unsigned char* to = m.colours->GetPointer(0);
  for (std::size_t i = 0; i < m.own_colour.size(); ++i)
    for (int k = 0; k < 3; ++k) to[3 * i + std::size_t(k)] = level(double(m.own_colour[i][k]));
  m.by_field = false;
  m.apply_colours();
}

const std::vector<glm::dvec3>& EditSurface::positions() const { return impl_->position; }
const std::vector<std::array<int, 3>>& EditSurface::triangles() const { return impl_->triangles; }

}  // namespace witherfield::vis
