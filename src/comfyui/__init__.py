"""A node of ComfyUI: a GLB with fewer faces and a new texture. In a folder of custom_nodes."""

import json
from io import BytesIO

from comfy.model_management import throw_exception_if_processing_interrupted
from comfy.utils import ProgressBar
from comfy_api.latest import ComfyExtension, Types, io


class SimplifyModel(io.ComfyNode):
    """The node. Equal inputs give equal bytes, so there is no seed, and ComfyUI may cache the result."""

    @classmethod
    def define_schema(cls):
        return io.Schema(
            node_id="FaqemSimplifyModel",
            display_name="Simplify 3D Model (faqem)",
            category="3d",
            description="Fewer faces, and a new texture that shows what the model showed. On the CPU.",
            search_aliases=["decimate", "retexture", "bake", "reduce faces"],
            inputs=[
                io.MultiType.Input("model_3d", types=[io.File3DGLB, io.File3DAny], tooltip="A GLB file"),
                io.Combo.Input("target", options=["faces", "ratio"], default="faces"),
                io.Int.Input("faces", default=20000, min=4, max=100_000_000, tooltip="Triangles of the result, for target faces"),
                io.Float.Input("ratio", default=0.1, min=0.0001, max=1.0, step=0.01, round=False,
                               tooltip="Share of the faces to keep, for target ratio"),
                io.Combo.Input("texture_size", options=["256", "512", "1024", "2048", "4096", "8192"], default="2048",
                               tooltip="Largest side of new images"),
                io.Float.Input("prune", default=1.0, min=0.0, max=100.0, step=0.1,
                               tooltip="Loose pieces smaller than this percentage of the model are removed; 0: none"),
            ],
            outputs=[io.File3DGLB.Output(display_name="model_3d"), io.String.Output(display_name="report")],
        )

    @classmethod
    def execute(cls, model_3d, target, faces, ratio, texture_size, prune):
        import faqem  # late: ComfyUI then starts without it, and the node says what is missing

        if model_3d.format != "glb":
            raise ValueError(f"model_3d: a GLB file is expected, not '{model_3d.format}'")
        bar = ProgressBar(100)

        def progress(phase, fraction):
            throw_exception_if_processing_interrupted()
            done = {"load": (0, 0), "weld": (0, 5), "simplify": (5, 50), "map": (50, 55), "bake": (55, 100)}
            start, end = done.get(phase, (100, 100))
            bar.update_absolute(int(start + (end - start) * fraction))

        result = faqem.simplify(faqem.Model.from_glb(model_3d.get_bytes()), texture_size=int(texture_size),
                                prune=f"{prune}%" if prune else None, progress=progress,
                                **({"faces": faces} if target == "faces" else {"ratio": ratio}))
        report = json.dumps({**result.report, "warnings": result.warnings}, indent=2)
        return io.NodeOutput(Types.File3D(BytesIO(result.to_glb()), file_format="glb"), report)


class FaqemExtension(ComfyExtension):
    """What ComfyUI asks for nodes."""

    async def get_node_list(self):
        return [SimplifyModel]


async def comfy_entrypoint():
    return FaqemExtension()
