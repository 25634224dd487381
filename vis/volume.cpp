#include "vis/volume.hpp"

#include <fmt/format.h>
#include <vtkCamera.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkProp3D.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/core/errors.hpp"
#include "vis/atomic_file.hpp"
#include "vis/legend.hpp"
#include "vis/overlay.hpp"
#include "vis/props.hpp"
#include "vis/render_window.hpp"
#include "vis/vtk_messages.hpp"

namespace witherfield::vis {
namespace {

void check(const VolumeOptions& o) {
  const auto require = [](bool ok, const char* name, double value, const char* range) {
    if (!ok) throw InvalidInput(fmt::format("{} = {} is out of range {}", name, value, range));
  };
  require(o.width_px >= 64 && o.width_px <= 16384, "width_px", o.width_px, "64..16384");
  require(o.height_px >= 64 && o.height_px <= 16384, "height_px", o.height_px, "64..16384");
  require(std::isfinite(o.azimuth_deg), "azimuth_deg", o.azimuth_deg, "(finite, degrees)");
  require(o.elevation_deg >= -90 && o.elevation_deg <= 90, "elevation_deg", o.elevation_deg, "-90..90");
  require(o.zoom >= 0.01 && o.zoom <= 100, "zoom", o.zoom, "0.01..100");
  require(o.iso_density > 0 && std::isfinite(o.iso_density), "iso_density", o.iso_density, "> 0");
}

/// The file with the arrays that the picture needs.
struct Source {
  Dataset dataset;
  bool image = false, of_cells = false;
  bool flat = false;  ///< an image one layer thick: a floor
  vtkDataArray *field = nullptr, *density = nullptr;  // density: of images only
};

Source load(const std::filesystem::path& input, const VolumeOptions& options) {
  const DatasetNames names = dataset_names(input);
  const auto has = [](const std::vector<std::string>& list, const std::string& name) {
    return std::find(list.begin(), list.end(), name) != list.end();
  };
  Source s;
  s.image = names.image;
  s.of_cells = !has(names.point_arrays, options.field);
  s.flat = names.image && !has(names.point_arrays, "density");
  if (s.of_cells && !(has(names.cell_arrays, options.field) && (s.flat || !names.image))) {
    std::vector<std::string> known = names.point_arrays;
    if (s.flat || !names.image) known.insert(known.end(), names.cell_arrays.begin(), names.cell_arrays.end());
    throw InvalidInput(fmt::format("'{}' has no field '{}'; it has: {}", input.string(), options.field,
                                   fmt::join(known, ", ")));
  }
  s.dataset = read_dataset(input, {options.field, "density", "radius_m"});
  vtkDataSet& data = *s.dataset.data;
  std::array<double, 6> bounds;
  data.GetBounds(bounds.data());
  if (s.flat && bounds[4] != bounds[5])
    throw InvalidInput(fmt::format("'{}' has no density, which gives a volume its shape", input.string()));
  s.field = (s.of_cells ? static_cast<vtkDataSetAttributes*>(data.GetCellData()) : data.GetPointData())
                ->GetArray(options.field.c_str());
  if (s.image && !s.flat) s.density = data.GetPointData()->GetArray("density");
  if (!s.field || (s.image && !s.flat && !s.density) || data.GetNumberOfPoints() == 0)
    throw InvalidInput(fmt::format("'{}' holds no points", input.string()));
  return s;
}

double sphere_radius(const Dataset& dataset) {
  if (vtkDataArray* radius = dataset.data->GetPointData()->GetArray("radius_m");
      radius && radius->GetNumberOfTuples()) {
    const double per_metre = dataset.length_unit == "mm" ? 1e3 : 1.0;
    if (radius->GetComponent(0, 0) > 0) return radius->GetComponent(0, 0) * per_metre;
  }
  return dataset.data->GetLength() / 400;
}

/// From above the viewer's left shoulder.
glm::dvec3 toward_light(const Framing& f) {
  return glm::normalize(-f.forward * 1.0 - f.right * 0.6 + f.up * 0.9);
}

Prop make_prop(const Source& s, const Colouring& colouring, const VolumeOptions& options,
               const glm::dvec3& to_light) {
  vtkDataSet& data = *s.dataset.data;
  if (!s.image) return poly_prop(data, *s.field, s.of_cells, sphere_radius(s.dataset), colouring);
  if (s.flat) return sheet_prop(data, *s.field, s.of_cells, colouring);
  if (options.surface) return surface_prop(data, *s.field, *s.density, options.iso_density, colouring);
  return volume_prop(data, *s.field, *s.density, colouring, to_light);
}

void set_camera(vtkRenderer& renderer, const Framing& f) {
  vtkCamera* camera = renderer.GetActiveCamera();
  camera->SetPosition(f.position.x, f.position.y, f.position.z);
  camera->SetFocalPoint(f.focal_point.x, f.focal_point.y, f.focal_point.z);
  camera->SetViewUp(f.up.x, f.up.y, f.up.z);
  camera->SetViewAngle(f.view_angle_deg);
  camera->SetWindowCenter(f.window_center.x, f.window_center.y);
  renderer.ResetCameraClippingRange();
}

void set_lights(vtkRenderer& renderer) {
  const auto add = [&](double x, double y, double z, double intensity) {
    vtkNew<vtkLight> light;
    light->SetLightTypeToCameraLight();
    light->SetPosition(x, y, z);
    light->SetFocalPoint(0, 0, 0);
    light->SetIntensity(intensity);
    renderer.AddLight(light);
  };
  renderer.AutomaticLightCreationOff();
  add(-0.6, 0.9, 1.0, 0.75);
  add(0.3, -0.2, 1.0, 0.35);
}

vtkSmartPointer<vtkRenderer> part_of(vtkRenderWindow& window, double left, double right) {
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  renderer->SetViewport(left, 0, right, 1);
  renderer->SetBackground(kPaper.r, kPaper.g, kPaper.b);
  window.AddRenderer(renderer);
  return renderer;
}

void add_legend(vtkRenderer& renderer, const Layout& layout, const Colouring& colouring) {
  switch (colouring.kind) {
    case Colouring::Kind::scalar:
      return add_colour_bar(renderer, layout, colouring.map, colouring.title, typeset_unit(colouring.unit));
    case Colouring::Kind::rgb:
      return add_legend_text(renderer, layout, colouring.title);
    case Colouring::Kind::direction:
      return add_legend_text(renderer, layout, colouring.title + ": red, green, blue = |x|, |y|, |z|");
  }
}

std::string caption(const Dataset& d) {
  std::string text;
  if (d.has_time) text = fmt::format("Day {:.1f}", d.time_days);
  if (d.has_wd) text += fmt::format("{}wd {:.2f}", text.empty() ? "" : "   ", d.wd);
  return text;
}

void write_png(vtkRenderWindow& window, const std::filesystem::path& png) {
  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(&window);
  grab->SetInputBufferTypeToRGB();
  grab->ReadFrontBufferOff();
  grab->ShouldRerenderOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(grab->GetOutputPort());
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* bytes = writer->GetResult();
  write_whole_file(png, {reinterpret_cast<const char*>(bytes->GetPointer(0)),
                         static_cast<std::size_t>(bytes->GetNumberOfValues())});
}

}  // namespace

void render_volume(const std::filesystem::path& input, const std::filesystem::path& png,
                   const VolumeOptions& options) {
  check(options);
  const Source source = load(input, options);
  const Colouring colouring =
      colouring_of(input, source.dataset, *source.field, source.density, options.range);

  const Layout layout(options.width_px, options.height_px);
  std::array<double, 6> bounds;
  source.dataset.data->GetBounds(bounds.data());
  const Framing framing = frame_box(bounds, options.azimuth_deg, options.elevation_deg, options.zoom,
                                    layout.width_px, layout.height_px, layout.data_rectangle());
  const Prop prop = make_prop(source, colouring, options, toward_light(framing));
  const RenderWindow window(options.width_px, options.height_px);
  const VtkMessages messages;
  window.get()->SetMultiSamples(8);
  const double split = double(layout.width_px) / options.width_px;
  const vtkSmartPointer<vtkRenderer> data = part_of(*window.get(), 0, split),
                                     legend = part_of(*window.get(), split, 1);
  data->AddViewProp(prop.get());
  add_axes(*data, layout, framing, bounds, source.dataset.length_unit, !source.flat);
  if (const std::string text = caption(source.dataset); !text.empty()) add_caption(*data, layout, text);
  add_legend(*legend, layout, colouring);
  set_lights(*data);
  set_camera(*data, framing);
  window.get()->Render();
  if (messages.has_error()) throw IoFailure("cannot render: " + messages.first_error());
  write_png(*window.get(), png);
}

}  // namespace witherfield::vis
