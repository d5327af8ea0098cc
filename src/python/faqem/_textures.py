"""Materials and images of a model, as arrays."""

from __future__ import annotations

import ctypes
import dataclasses
from typing import Any, NamedTuple

import numpy
from numpy.typing import NDArray

from ._arrays import view_array
from ._library import Owner, create, library

# faqem_texture
_uses = ["base_color", "metallic_roughness", "normal", "occlusion", "emissive"]
_no_index = 2**32 - 1


class Texture(NamedTuple):
    """An image that a material uses."""

    image: int  #: index into Model.images
    uv_set: int  #: index into Part.uvs; a texture transform of the file is not applied to these


@dataclasses.dataclass(frozen=True)
class Material:
    """A material of a model."""

    name: str
    textures: dict[str, Texture]  #: by use: "base_color", "metallic_roughness", "normal", "occlusion", "emissive"


class Image:
    """An image of a model, as it is in the file. Keeps the model alive."""

    name: str
    mime_type: str  #: for example "image/png"; "" if unknown

    def __init__(self, model: Any, index: int) -> None:
        self._model, self._index = model, index
        self.name = library.faqem_asset_image_name(model._handle, index).decode(errors="replace")
        self.mime_type = library.faqem_asset_image_mime_type(model._handle, index).decode(errors="replace")

    def __repr__(self) -> str:
        return f"<faqem.Image {self._index} {self.name!r} {self.mime_type}>"

    @property
    def encoded(self) -> bytes:
        """A copy of the content of the image file."""
        size = ctypes.c_size_t()
        content = library.faqem_asset_image_bytes(self._model._handle, self._index, ctypes.byref(size))
        return ctypes.string_at(content, size.value) if content else b""

    def pixels(self) -> NDArray[numpy.uint8]:
        """Decodes the image: PNG, JPEG or WebP.

        Returns (height, width, 4) uint8, RGBA with the top row first, sRGB as in the file; without an alpha channel
        (height, width, 3), which is a view of such an array. It is new at each call, and may be changed. Raises
        InputError if the image is damaged or larger than 16384 x 16384, UnsupportedError for other kinds.
        """
        owner = Owner(create(library.faqem_asset_decode_image, self._model._handle, self._index), library.faqem_pixels_destroy)
        shape = (library.faqem_pixels_height(owner.handle), library.faqem_pixels_width(owner.handle), 4)
        rgba = view_array(library.faqem_pixels_rgba(owner.handle), shape, owner, writable=True)
        return rgba if library.faqem_pixels_has_alpha(owner.handle) else rgba[..., :3]


def materials(model: Any) -> list[Material]:
    """Returns the materials of a model."""
    found = []
    for material in range(library.faqem_asset_material_count(model._handle)):
        textures = {}
        for use, name in enumerate(_uses):
            uv_set = ctypes.c_uint32()
            image = library.faqem_asset_material_image(model._handle, material, use, ctypes.byref(uv_set))
            if image != _no_index:
                textures[name] = Texture(image, uv_set.value)
        name = library.faqem_asset_material_name(model._handle, material).decode(errors="replace")
        found.append(Material(name, textures))
    return found
