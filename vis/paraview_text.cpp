#include "vis/paraview_text.hpp"

namespace witherfield::vis::paraview_text {

const char* const kHead = R"PY(# Opens this run in ParaView:        paraview --script=view_in_paraview.py
# Saves one picture without a window:  pvbatch view_in_paraview.py picture.png [day]
#
# One field is shown, with its legend. Other fields: tick them under the series, Apply, and colour by them; their colour
# scales are fixed to the range of the whole run. Times are days; wd is 0 fresh .. 1 dry, of floors the share of the visits.
# Grass: the surface (density = 0.2) is shown; the volume is set up too: click the eye beside grass.pvd.
import os
import sys

from paraview.simple import *

)PY";

const char* const kCommon = R"PY(


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


here = next((f for f in folders_to_try() if os.path.exists(os.path.join(f, SERIES))), None)
if here is None:
    raise RuntimeError(SERIES + ' not found: start ParaView in the folder that holds it and view_in_paraview.py')

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


def first_field():
    """The first field of the table that is not (nearly) the same everywhere and always."""
    return next((f for f in FIELDS if f[4] - f[3] > 0.02 * max(abs(f[3]), abs(f[4]))), FIELDS[0])


def clock(source, view, degree):
    """The day, and a Python expression of wd (of floors the share of the visits), at the top of the view."""
    day = AnnotateTimeFilter(registrationName='day', Input=source)
    day.Format = 'Day {time:.1f}'
    note(day, view, 'Upper Left Corner')
    wd = PythonAnnotation(registrationName='wd', Input=source)
    wd.ArrayAssociation = 'Field Data'
    wd.Expression = degree
    note(wd, view, 'Upper Center')


def start_at(source, view, day, first):
    """The time last: with the first run's welcome window open, ParaView waits here until it is closed."""
    scene = GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    times = list(getattr(source, 'TimestepValues', None) or [0.0])
    scene.AnimationTime = min(times, key=lambda t: abs(t - day)) if day is not None else times[0 if first else -1]
    view.ViewTime = scene.AnimationTime


)PY";

const char* const kGrass = R"PY(def show_grass(view):
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

    clock(grass, view, "'wd %.2f' % wd[0]")
    axes(view, 'mm')
    look_at(view, grass, (0.7, -2.0, 0.75))

    return smooth, grass


def show_terrain(view):
    terrain = XMLPolyDataReader(registrationName='terrain.vtp', FileName=[in_run('terrain.vtp')])
    shown = Show(terrain, view)
    ColorBy(shown, ('POINTS', 'elevation_m'))
    lut = GetColorTransferFunction('elevation_m')
    lut.ApplyPreset('Linear Green (Gr4L)', True)
    legend(lut, view, 'Elevation', 'm')
    axes(view, 'm')
    look_at(view, terrain, (0.8, -1.5, 0.9))


TERRAIN = os.path.exists(in_run('terrain.vtp'))
show, FIRST = show_grass, True
)PY";

const char* const kSurface = R"PY(def show_surface(view):
    series = PVDReader(registrationName=SERIES, FileName=in_run(SERIES))
    luts = {name: fix_scale(name, lo, hi, preset, invert)
            for name, title, unit, lo, hi, preset, invert in FIELDS}
    shown = Show(series, view)
    shown.Ambient, shown.Diffuse, shown.Specular = 0.3, 0.75, 0.05
    if FIELDS:
        name, title, unit, lo, hi, preset, invert = first_field()
        ColorBy(shown, ('POINTS', name))
        luts[name].RescaleTransferFunction(lo, hi)   # colouring by a field rescales it: put the run's range back
        legend(luts[name], view, title, unit)
    clock(series, view, "'wd %.2f' % wd[0]")
    axes(view, 'mm')
    look_at(view, series, (0.5, -2.2, 0.9))
    return series, series


TERRAIN = False
show, FIRST = show_surface, True
)PY";

const char* const kFloor = R"PY(def show_floor(view):
    series = PVDReader(registrationName=SERIES, FileName=in_run(SERIES))
    luts = {name: fix_scale(name, lo, hi, preset, invert)
            for name, title, unit, lo, hi, preset, invert in FIELDS}
    shown = Show(series, view)
    shown.SetRepresentationType('Surface')
    shown.Ambient, shown.Diffuse, shown.Specular = 1.0, 0.0, 0.0   # a map, not a lit thing
    if FIELDS:
        name, title, unit, lo, hi, preset, invert = first_field()
        ColorBy(shown, ('CELLS', name))
        luts[name].RescaleTransferFunction(lo, hi)   # colouring by a field rescales it: put the run's range back
        legend(luts[name], view, title, unit)
    clock(series, view, "'%.3g %% of the visits' % (100 * wd[0])")
    axes(view, 'm')
    look_from_above(view, series)
    return series, series


def look_from_above(view, source):
    source.UpdatePipeline()
    b = source.GetDataInformation().GetBounds()
    aim = [(b[0] + b[1]) / 2 + 0.08 * (b[1] - b[0]), (b[2] + b[3]) / 2, (b[4] + b[5]) / 2]
    view.CameraParallelProjection = 1
    view.CameraParallelScale = 0.6 * max(b[3] - b[2], (b[1] - b[0]) * 0.6)
    view.CameraFocalPoint = aim
    view.CameraPosition = [aim[0], aim[1], aim[2] + 2 * max(b[1] - b[0], b[3] - b[2])]
    view.CameraViewUp = [0, 1, 0]


TERRAIN = False
show, FIRST = show_floor, False
)PY";

const char* const kMain = R"PY(
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
shown, series = show(view)
start_at(series, view, DAY, FIRST)
if TERRAIN and not PICTURE:
    ground = new_view()                 # in a tab of its own
    AssignViewToLayout(view=ground, layout=CreateLayout('Terrain'), hint=0)
    show_terrain(ground)
    SetActiveView(view)
SetActiveSource(shown)
RenderAllViews()
if PICTURE:
    layout.SetSize(1280, 720)
    SaveScreenshot(PICTURE, layout, ImageResolution=[1280, 720])
)PY";

}  // namespace witherfield::vis::paraview_text
