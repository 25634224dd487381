// The ParaView start-up script of a run. Everything that depends on the run is in the table FIELDS at its
// top.
#include <fmt/format.h>

#include <algorithm>

#include "sim/core/fields.hpp"
#include "vis/atomic_file.hpp"
#include "vis/writers.hpp"

namespace witherfield::vis {
namespace {

constexpr const char* kHead = R"PY(# Opens this run in ParaView:        paraview --script=view_in_paraview.py
# Saves one picture without a window:  pvbatch view_in_paraview.py picture.png [day]
#
# Shown: the surface of the grass (density = 0.2) coloured by relative water content. The volume itself is set up too:
# click the eye beside grass.pvd. Other fields: tick them under grass.pvd, Apply, and colour by them; their
# colour scales are fixed to the range of the whole run. Lengths are millimetres, times days, wd is 0 fresh .. 1 dry.
import os
import sys

from paraview.simple import *

)PY";

constexpr const char* kBody = R"PY(


def folders_to_try():
    """Where this script may lie. ParaView's window runs it without telling it its own name."""
    if '__file__' in globals():
        yield os.path.dirname(os.path.abspath(__file__))
    arguments = list(sys.argv)
    try:
        with open('/proc/self/cmdline', encoding='utf-8', errors='replace') as f:
            arguments += f.read().split('\0')
    except OSError:
        pass
    for argument in arguments:
        if argument.endswith('.py'):
            yield os.path.dirname(os.path.abspath(argument.split('=', 1)[-1]))
    yield os.getcwd()


here = next((f for f in folders_to_try() if os.path.exists(os.path.join(f, 'grass.pvd'))), None)
if here is None:
    raise RuntimeError('grass.pvd not found: start ParaView in the folder that holds it and view_in_paraview.py')

INK = [0.13, 0.15, 0.18]
paraview.simple._DisableFirstRenderCameraReset()


def in_run(name):
    return os.path.join(here, name)


def fix_scale(name, lo, hi, preset, invert):
    lut = GetColorTransferFunction(name)
    lut.ApplyPreset(preset, True)
    if invert:
        lut.InvertTransferFunction()
    lut.RescaleTransferFunction(lo, hi)
    lut.AutomaticRescaleRangeMode = 'Never'
    return lut


def legend(lut, view, title, unit):
    bar = GetScalarBar(lut, view)
    bar.Title = title
    bar.ComponentTitle = '(%s)' % unit if unit != '1' else ''
    bar.TitleColor = bar.LabelColor = INK
    bar.TitleFontSize, bar.LabelFontSize = 16, 15
    bar.AutomaticLabelFormat = 0
    bar.LabelFormat = bar.RangeLabelFormat = '%.3g'
    bar.HorizontalTitle = 1
    bar.ScalarBarLength = 0.5
    bar.WindowLocation = 'Any Location'
    bar.Position = [0.84, 0.22]
    bar.Visibility = 1


def new_view():
    view = CreateView('RenderView')
    view.UseColorPaletteForBackground = 0
    view.Background = [0.965, 0.972, 0.98]
    view.OrientationAxesVisibility = 1
    view.OrientationAxesLabelColor = INK
    return view


def axes(view, unit):
    grid = view.AxesGrid
    grid.Visibility = 1
    grid.XTitle, grid.YTitle, grid.ZTitle = 'x (%s)' % unit, 'y (%s)' % unit, 'z (%s)' % unit
    for item in ('XTitleColor', 'YTitleColor', 'ZTitleColor', 'XLabelColor', 'YLabelColor', 'ZLabelColor'):
        setattr(grid, item, INK)
    grid.GridColor = [0.62, 0.65, 0.69]
    grid.AxesToLabel = 2 | 4 | 8    # each axis once


def look_at(view, source, azimuth):
    source.UpdatePipeline()
    b = source.GetDataInformation().GetBounds()
    if b[0] > b[1]:
        return
    center = [(b[2 * a] + b[2 * a + 1]) / 2 for a in range(3)]
    size = max(b[2 * a + 1] - b[2 * a] for a in range(3))
    view.CameraViewAngle = 30
    # Aimed a little to the right of the middle, which leaves room for the legend there.
    length = (azimuth[0] ** 2 + azimuth[1] ** 2) ** 0.5
    aim = [center[0] - 0.12 * size * azimuth[1] / length, center[1] + 0.12 * size * azimuth[0] / length, center[2]]
    view.CameraFocalPoint = aim
    view.CameraPosition = [aim[a] + azimuth[a] * size for a in range(3)]
    view.CameraViewUp = [0, 0, 1]


def note(source, view, place):
    shown = Show(source, view)
    shown.Color = INK
    shown.FontSize = 18
    shown.WindowLocation = place
    return shown


def show_grass(view):
    grass = PVDReader(registrationName='grass.pvd', FileName=in_run('grass.pvd'))
    grass.PointArrays = ['density', 'water']   # the others when they are wanted: each costs time at every step
    if os.path.exists(in_run('grass_optics.pvd')):
        optics = PVDReader(registrationName='grass_optics.pvd', FileName=in_run('grass_optics.pvd'))
        optics.PointArrays = ['density']       # not shown: normals, tangents and colours are large

    luts = {name: fix_scale(name, lo, hi, preset, invert)
            for name, title, unit, lo, hi, preset, invert in FIELDS}

    volume = Show(grass, view, 'UniformGridRepresentation')
    ColorBy(volume, ('POINTS', 'water'))
    volume.SetRepresentationType('Volume')
    volume.UseSeparateOpacityArray = 1
    volume.OpacityArrayName = ['POINTS', 'density']
    opacity = GetOpacityTransferFunction('density')
    opacity.Points = [0.0, 0.0, 0.5, 0.0, 0.05, 0.0, 0.5, 0.0, 0.5, 0.85, 0.5, 0.0, 1.0, 0.95, 0.5, 0.0]
    volume.ScalarOpacityFunction = opacity

    surface = Contour(registrationName='grass surface', Input=grass)
    surface.ContourBy = ['POINTS', 'density']
    surface.Isosurfaces = [0.2]
    smooth = Smooth(registrationName='smoothed surface', Input=surface)   # the voxels' steps
    smooth.NumberofIterations = 30
    shown = Show(smooth, view)
    shown.Ambient, shown.Diffuse, shown.Specular = 0.35, 0.7, 0.0
    ColorBy(shown, ('POINTS', 'water'))
    shown.LookupTable = luts.get('water', shown.LookupTable)
    # Colouring by a field rescales it: put the run's range back.
    for name, title, unit, lo, hi, preset, invert in FIELDS:
        if name == 'water':
            luts[name].RescaleTransferFunction(lo, hi)
            legend(luts[name], view, title, unit)
    if VOLUME:
        Hide(smooth, view)
    else:
        Hide(grass, view)

    clock = AnnotateTimeFilter(registrationName='day', Input=grass)
    clock.Format = 'Day {time:.1f}'
    note(clock, view, 'Upper Left Corner')
    wd = PythonAnnotation(registrationName='wd', Input=grass)
    wd.ArrayAssociation = 'Field Data'
    wd.Expression = "'wd %.2f' % wd[0]"
    note(wd, view, 'Upper Center')
    axes(view, 'mm')
    look_at(view, grass, (0.7, -2.0, 0.75))

    # The time last: with the first run's welcome window open, ParaView waits here until it is closed.
    scene = GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    times = list(getattr(grass, 'TimestepValues', None) or [0.0])
    scene.AnimationTime = min(times, key=lambda t: abs(t - DAY)) if DAY is not None else times[0]
    view.ViewTime = scene.AnimationTime
    return smooth


def show_terrain(view):
    terrain = XMLPolyDataReader(registrationName='terrain.vtp', FileName=[in_run('terrain.vtp')])
    shown = Show(terrain, view)
    ColorBy(shown, ('POINTS', 'elevation_m'))
    lut = GetColorTransferFunction('elevation_m')
    lut.ApplyPreset('Linear Green (Gr4L)', True)
    legend(lut, view, 'Elevation', 'm')
    axes(view, 'm')
    look_at(view, terrain, (0.8, -1.5, 0.9))


PICTURE = next((a for a in sys.argv[1:] if a.endswith('.png')), None)
DAY = None
if PICTURE and sys.argv[-1] != PICTURE:
    DAY = float(sys.argv[-1])
VOLUME = False

layout = GetLayoutByName('Layout #1') or CreateLayout('Layout #1')
view = GetActiveView() if not PICTURE else None
if view is None or view.GetXMLName() != 'RenderView':
    view = new_view()
    AssignViewToLayout(view=view, layout=layout, hint=0)
else:
    view.UseColorPaletteForBackground = 0
    view.Background = [0.965, 0.972, 0.98]
    view.OrientationAxesLabelColor = INK
surface = show_grass(view)
if TERRAIN and os.path.exists(in_run('terrain.vtp')) and not PICTURE:
    ground = new_view()                 # in a tab of its own
    AssignViewToLayout(view=ground, layout=CreateLayout('Terrain'), hint=0)
    show_terrain(ground)
    SetActiveView(view)
SetActiveSource(surface)
RenderAllViews()
if PICTURE:
    layout.SetSize(1280, 720)
    SaveScreenshot(PICTURE, layout, ImageResolution=[1280, 720])
)PY";

struct Preset {
  std::string_view field;
  const char* name;
  bool invert;
};
// As in our own pictures (colour_map.cpp), by the names of ParaView's presets.
constexpr Preset kPresets[] = {{"water", "Viridis (matplotlib)", true},
                               {"chlorophyll_ug_cm2", "Linear Green (Gr4L)", true},
                               {"stress_vein_MPa", "Inferno (matplotlib)", false},
                               {"stress_mesophyll_MPa", "Inferno (matplotlib)", false},
                               {"strain_shrink", "Inferno (matplotlib)", false},
                               {"tissue", "Viridis (matplotlib)", true},
                               {"blade_id", "Turbo", false},
                               {"density", "Viridis (matplotlib)", true}};

std::string field_line(const Preset& preset, ValueRange range) {
  const FieldSpec& spec = field_spec(preset.field);
  const char* name = preset.name;
  if (spec.name.starts_with("stress_") && range.lo < 0 && range.hi > 0) {
    name = "Cool to Warm (Extended)";
    range.hi = std::max(range.hi, -range.lo);
    range.lo = -range.hi;
  }
  if (!(range.hi > range.lo)) range.hi = range.lo + 1;
  return fmt::format("    ('{}', '{}', '{}', {}, {}, '{}', {}),\n", spec.name, spec.title, spec.unit,
                     range.lo, range.hi, name, preset.invert ? "True" : "False");
}

}  // namespace

void write_paraview_script(const std::filesystem::path& file, const ValueRanges& ranges, bool has_terrain) {
  std::string script = kHead;
  script += "# name, title, unit, lowest and highest value of the run, colour preset, inverted\nFIELDS = [\n";
  for (const Preset& p : kPresets)
    if (const auto at = ranges.find(std::string(p.field)); at != ranges.end())
      script += field_line(p, at->second);
  script += fmt::format("]\nTERRAIN = {}\n", has_terrain ? "True" : "False");
  write_whole_file(file, script + kBody);
}

}  // namespace witherfield::vis
