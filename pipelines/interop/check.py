"""What Python reads of final.mpts and its exports against what the tools say of them."""
import json
import sys

import numpy as np


def near(what, found, expected, tolerance):
    print(what, found, expected)
    assert abs(found - expected) <= tolerance * abs(expected), what


def volumes():
    """Adhesive of the state and of the specimen by wp-metrics, um3."""
    return [float(line) for line in open("volumes.txt")]


def particles():
    import bondline

    state, specimen = bondline.read("final.mpts"), bondline.read("specimen.mpts")
    of_state, of_specimen = volumes()
    near("volume", 1e18 * state.points["volume"].sum(dtype=float), of_state, 1e-6)
    near("of voxels", 1e18 * specimen.points["volume"].sum(), of_specimen, 1e-6)
    near("of labels", 1e18 * specimen.voxel**3 * (specimen.labels == bondline.ADHESIVE).sum(), of_specimen, 1e-6)
    low, high = (specimen.points["position"].min(0), specimen.points["position"].max(0))
    assert (low >= specimen.box[0]).all() and (high <= specimen.box[1]).all()
    exported = np.load("final.npz")
    for name, values in state.points.items():
        assert np.array_equal(np.squeeze(exported[name]), values), name
    assert state.units["pressure"] == "Pa" and state.kind == "state" and state.normal == "y"
    nz, ny, nx = state.labels.shape
    open("size.txt", "w").write(f"{nx} x {ny} x {nz}\n")
    with open("sums.txt", "w") as out:
        for name, values in state.arrays.items():
            flat = values.ravel().astype(float)
            weights = np.arange(1, flat.size + 1) % 1009
            print(name.replace("-", "_"), flat.size, f"{flat @ weights:.6e}", file=out)


def tiff():
    import bondline
    import tifffile

    pages = tifffile.imread("final.tiff")
    state = bondline.read("final.mpts")
    assert pages.shape == state.labels.shape, (pages.shape, state.labels.shape)
    # Wood is where the file has it, but for voxels that adhesive takes more than half of.
    wood = state.labels == bondline.WOOD
    assert (pages[wood] == bondline.WOOD).mean() > 0.98
    near("volume", 1e18 * state.voxel**3 * (pages == bondline.ADHESIVE).sum(), volumes()[0], 0.005)


def vtk():
    import bondline
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLPolyDataReader

    def opened(reader, name):
        reader.SetFileName(name)
        reader.Update()
        return reader.GetOutput()

    state = bondline.read("final.mpts")
    points = opened(vtkXMLPolyDataReader(), "final.vtp")
    assert np.allclose(vtk_to_numpy(points.GetPoints().GetData()), state.points["position"], rtol=1e-6)
    image = opened(vtkXMLImageDataReader(), "final.vti")
    assert image.GetNumberOfCells() == state.labels.size
    labels = vtk_to_numpy(image.GetCellData().GetArray(0))
    near("volume", 1e18 * state.voxel**3 * (labels == bondline.ADHESIVE).sum(), volumes()[0], 0.005)


def notebook(path):
    """Runs the cells of a notebook one after another, as a kernel does."""
    place = {}
    for cell in json.load(open(path))["cells"]:
        if cell["cell_type"] == "code":
            exec("".join(cell["source"]), place)


globals()[sys.argv[1]](*sys.argv[2:])
