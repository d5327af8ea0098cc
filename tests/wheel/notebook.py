"""Executes the notebook in a new folder, as Jupyter does, and prints what it printed.

Usage: notebook.py NOTEBOOK [--write]     with --write, stores the outputs
"""

import pathlib
import sys
import tempfile

import nbclient
import nbformat


def printed(notebook):
    """The texts of standard output, without those of the progress."""
    return "".join(output.text for cell in notebook.cells for output in cell.get("outputs", [])
                   if output.get("name") == "stdout")


path = pathlib.Path(sys.argv[1])
notebook = nbformat.read(path, as_version=4)
nbformat.validate(notebook)
stored = printed(notebook)
with tempfile.TemporaryDirectory() as folder:
    nbclient.NotebookClient(notebook, timeout=300, resources={"metadata": {"path": folder}}).execute()
    made = pathlib.Path(folder, "faqem-notebook")
    assert len(list((made / "light").glob("*.glb"))) == 3
    assert (made / "web.glb").stat().st_size <= 100_000 < (made / "asset.glb").stat().st_size
    assert (made / "asset_LOD.glb").exists()
outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
text = printed(notebook)
print(text, end="")
for expected in ("left out: ", "500000 faces\n", "faces, at most", " dB\n"):
    assert expected in text, expected
assert "image/png" in outputs[-1].data
if sys.argv[2:] == ["--write"]:
    for cell in notebook.cells:
        cell.metadata.pop("execution", None)  # times
        if "outputs" in cell:
            cell.outputs = [output for output in cell.outputs if output.get("name") != "stderr"]
    nbformat.write(notebook, path)
else:
    assert stored.count("\n") == text.count("\n"), "the outputs are missing or old; store them with --write"
assert path.stat().st_size <= 300_000, path.stat().st_size
