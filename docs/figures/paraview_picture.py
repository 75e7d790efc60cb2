#!/usr/bin/env pvpython
"""A picture of an increment by ParaView: stresses in colours, forces of contacts as arrows, the initial shape as a line.

xvfb-run -a pvpython --force-offscreen-rendering docs/figures/paraview_picture.py foot/path.pvd foot.png [INCREMENT]

The path has solids, contacts and obstacles. Without INCREMENT it is the last one.
"""
import sys

try:
    from paraview import servermanager, simple
except ImportError:
    sys.exit('ParaView is missing: apt install paraview python3-paraview xvfb, and run this file by pvpython')

SIZE, STRIP = (1100, 560), 120  # of the picture, and below the structure [pixels]
LONGEST_ARROW = 0.25  # of the width of the structure
MARGIN = 0.04  # of the width or height, beside the structure
DARK, RED = (0.27, 0.33, 0.42), (0.70, 0.09, 0.17)
LIGHT_TO_DARK = [0.0, 0.91, 0.93, 0.95, 0.5, 0.96, 0.69, 0.51, 1.0, 0.61, 0.18, 0.06]


def box_of(*sources):
    """((least x, largest x), (least y, largest y)) at the time that is shown."""
    bounds = [source.GetDataInformation().GetBounds() for source in sources]
    return [(min(b[axis] for b in bounds), max(b[axis + 1] for b in bounds)) for axis in (0, 2)]


def show_structure(structure, view):
    shown = simple.Show(structure, view)
    shown.Representation = 'Surface With Edges'
    shown.EdgeColor = DARK
    shown.Ambient, shown.Diffuse = 1.0, 0.0  # the colours of the bar
    shown.NonlinearSubdivisionLevel = 3
    simple.ColorBy(shown, ('CELLS', 'mises'))
    colours = simple.GetColorTransferFunction('mises')
    largest = structure.CellData['mises'].GetRange()[1]
    colours.RGBPoints = [largest * value if i % 4 == 0 else value for i, value in enumerate(LIGHT_TO_DARK)]
    bar = simple.GetScalarBar(colours, view)
    bar.Title, bar.ComponentTitle = 'von Mises stress [force/length^2]', ''
    bar.Orientation, bar.WindowLocation = 'Horizontal', 'Any Location'
    bar.Position, bar.ScalarBarLength, bar.ScalarBarThickness = [0.53, 0.04], 0.42, 16
    bar.TitleFontSize = bar.LabelFontSize = 16
    bar.TitleColor = bar.LabelColor = [0.0, 0.0, 0.0]
    bar.RangeLabelFormat = bar.LabelFormat = '%-#.2g'
    bar.AddRangeLabels = 0
    shown.SetScalarBarVisibility(view, True)


def show_contact_forces(structure, view, width):
    largest = structure.PointData['contact_force'].GetRange(-1)[1]
    arrows = simple.Glyph(Input=structure, GlyphType='Arrow')
    arrows.OrientationArray, arrows.ScaleArray = ['POINTS', 'contact_force'], ['POINTS', 'contact_force']
    arrows.GlyphMode, arrows.ScaleFactor = 'All Points', LONGEST_ARROW * width / largest
    arrows.GlyphType.TipRadius, arrows.GlyphType.TipLength, arrows.GlyphType.ShaftRadius = 0.07, 0.22, 0.018
    shown = simple.Show(arrows, view)
    shown.ColorArrayName = ['POINTS', '']
    shown.AmbientColor = shown.DiffuseColor = RED
    shown.Ambient, shown.Diffuse = 1.0, 0.0
    shown.Position = [0.0, 0.0, 0.1 * width]  # above the elements
    return largest


def show_lines(source, view, colour, width):
    shown = simple.Show(source, view)
    shown.Representation = 'Wireframe'
    shown.ColorArrayName = ['POINTS', '']
    shown.AmbientColor = shown.DiffuseColor = colour
    shown.LineWidth = width


def say(text, view, place):
    shown = simple.Show(text, view)
    shown.FontSize, shown.Color = 16, [0.0, 0.0, 0.0]
    shown.WindowLocation, shown.Position = 'Any Location', place


def main(collection, picture, increment=None):
    path = simple.OpenDataFile(collection)
    time = path.TimestepValues[-1] if increment is None else float(increment)
    view = simple.CreateView('RenderView')
    view.ViewSize, view.ViewTime = SIZE, time
    view.UseColorPaletteForBackground, view.Background = 0, [1.0, 1.0, 1.0]
    view.OrientationAxesVisibility = 0

    structure = simple.ExtractBlock(Input=path, Selectors=['/Root/structure'])
    obstacles = simple.ExtractBlock(Input=path, Selectors=['/Root/obstacles'])
    initial = simple.WarpByVector(Input=structure, Vectors=['POINTS', 'displacement'], ScaleFactor=-1.0)
    outline = simple.FeatureEdges(Input=simple.ExtractSurface(Input=initial))
    for source in structure, obstacles, outline:
        source.UpdatePipeline(time)
    for array in 'mises', 'contact_force':
        if array not in (*structure.CellData.keys(), *structure.PointData.keys()):
            sys.exit('%s has no array %s' % (collection, array))
    box = box_of(structure, outline)
    width, height = (high - low for low, high in box)

    show_structure(structure, view)
    largest = show_contact_forces(structure, view, width)
    show_lines(obstacles, view, (0.45, 0.45, 0.45), 3)
    show_lines(outline, view, (0.6, 0.6, 0.6), 1.5)
    load_factor = servermanager.Fetch(path).GetBlock(0).GetBlock(0).GetFieldData().GetArray('load_factor').GetValue(0)
    say(simple.Text(Text='increment %d, load factor %.3g' % (time, load_factor)), view, [0.03, 0.085])
    say(simple.Text(Text='longest arrow: force of a contact %.2g [force]' % largest), view, [0.03, 0.03])

    # The structure above, the colour bar below.
    pixel = (1.0 + 2.0 * MARGIN) * max(width / SIZE[0], height / (SIZE[1] - STRIP))  # [length]
    centre = [0.5 * (low + high) for low, high in box]
    centre[1] -= 0.5 * STRIP * pixel
    view.CameraParallelProjection, view.CameraParallelScale = 1, 0.5 * SIZE[1] * pixel
    view.CameraPosition, view.CameraFocalPoint = [*centre, 10.0 * width], [*centre, 0.0]
    simple.SaveScreenshot(picture, view, ImageResolution=SIZE)


if __name__ == '__main__':
    main(*sys.argv[1:])
