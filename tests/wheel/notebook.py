"""Executes the notebook in a new folder, as Jupyter does, and prints what it printed. Usage: notebook.py NOTEBOOK"""

import pathlib
import sys
import tempfile

import nbclient
import nbformat

notebook = nbformat.read(sys.argv[1], as_version=4)
nbformat.validate(notebook)
for cell in notebook.cells:
    assert not cell.get("outputs"), "the notebook must be stored without outputs"
with tempfile.TemporaryDirectory() as folder:
    nbclient.NotebookClient(notebook, timeout=300, resources={"metadata": {"path": folder}}).execute()
    made = pathlib.Path(folder, "faqem-notebook")
    assert len(list((made / "light").glob("*.glb"))) == 3
    assert (made / "web.glb").stat().st_size <= 100_000 < (made / "asset.glb").stat().st_size
    assert (made / "asset_LOD.glb").exists()
outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
text = "".join(output.text for output in outputs if output.get("name") == "stdout")
print(text, end="")
for expected in ("left out: ", "500000 faces\n", "faces, at most", " dB\n"):
    assert expected in text, expected
assert "image/png" in outputs[-1].data
