"""Draws the picture of the README: the results of a sample on its slave surface, as ParaView shows them.

    inpact eval decks/weld-mesh/weld-mesh.inp -o weld.vtu
    pip install pyvista
    python3 tests/python/weld_picture.py weld.vtu docs/weld-mesh.png
"""

import sys

import pyvista

grid = pyvista.read(sys.argv[1])
# Millimetres, and the crown of 10 micrometres 60 times as high.
grid.points = grid.points * 1e3
grid.points[:, 2] = (grid.points[:, 2] - 1.0) * 60.0
plotter = pyvista.Plotter(off_screen=True, window_size=(640, 360))
plotter.set_background("white")
bar = {"title": "heat_conduction (W/m2)", "color": "black", "fmt": "%.2g", "n_labels": 4}
plotter.add_mesh(grid, scalars="heat_conduction", show_edges=True, cmap="viridis", scalar_bar_args=bar)
plotter.camera_position = "iso"
plotter.camera.zoom(1.5)
plotter.screenshot(sys.argv[2])
