"""Tests of the UVs, materials and images of a model."""

import gc
import struct
import unittest
import zlib

import faqem
import numpy
from numpy.testing import assert_array_equal
from test_arrays import InFolder, flat_grid


def write_png(file, pixels):
    """Writes an array (height, width, 3 or 4) uint8."""
    height, width, channels = pixels.shape

    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    header = struct.pack(">IIBBBBB", width, height, 8, {3: 2, 4: 6}[channels], 0, 0, 0)
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)
    file.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


class Textures(InFolder):
    def setUp(self):
        super().setUp()
        self.pixels = numpy.random.default_rng(1).integers(0, 255, (4, 6, 3)).astype(numpy.uint8)

    def textured(self, pixels):
        """Loads a flat grid with the image, whose left half has another material without image."""
        write_png(self.folder / "colours.png", pixels)
        (self.folder / "grid.mtl").write_text("newmtl painted\nmap_Kd colours.png\nnewmtl plain\nKd 1 0 0\n")
        vertices, triangles = flat_grid(4)
        lines = ["mtllib grid.mtl", *(f"v {x} {y} {z}\nvt {x / 4} {y / 4}" for x, y, z in vertices)]
        for name, few in (("painted", triangles[16:]), ("plain", triangles[:16])):
            lines += [f"usemtl {name}", *(f"f {a}/{a} {b}/{b} {c}/{c}" for a, b, c in few + 1)]
        (self.folder / "grid.obj").write_text("\n".join(lines) + "\n")
        return faqem.load(self.folder / "grid.obj")

    def test_each_vertex_has_uvs_with_v_pointing_down(self):
        (part,) = self.textured(self.pixels).parts
        self.assertEqual([(uvs.dtype, uvs.shape) for uvs in part.uvs], [(numpy.float32, (len(part.vertices), 2))])
        assert_array_equal(part.uvs[0], part.vertices[:, :2] / 4 * [1, -1] + [0, 1])

    def test_faces_have_materials_and_these_images(self):
        model = self.textured(self.pixels)
        names = [material.name for material in model.materials]
        (part,) = model.parts
        self.assertEqual([names[material] for material in part.materials], ["painted"] * 16 + ["plain"] * 16)
        (image,) = model.images
        for material in model.materials:
            self.assertEqual(material.textures, {"base_color": (0, 0)} if material.name == "painted" else {})
        self.assertEqual((image.mime_type, image.encoded), ("image/png", (self.folder / "colours.png").read_bytes()))
        plain = faqem.Model.from_arrays(*flat_grid(2))
        self.assertEqual((plain.materials, plain.images, plain.parts[0].uvs), ([], [], []))
        self.assertEqual(set(plain.parts[0].materials), {2**32 - 1})

    def test_pixels_have_three_or_four_channels(self):
        (image,) = self.textured(self.pixels).images
        pixels = image.pixels()
        self.assertEqual(pixels.dtype, numpy.uint8)
        assert_array_equal(pixels, self.pixels)
        pixels[...] = 0  # the caller's own array
        assert_array_equal(image.pixels(), self.pixels)
        with_alpha = numpy.dstack([self.pixels, self.pixels[..., 0] // 2])
        assert_array_equal(self.textured(with_alpha).images[0].pixels(), with_alpha)

    def test_a_damaged_image_is_named(self):
        self.textured(self.pixels)
        file = self.folder / "colours.png"
        file.write_bytes(file.read_bytes()[:60])
        (image,) = faqem.load(self.folder / "grid.obj").images
        with self.assertRaisesRegex(faqem.InputError, "colours.png"):
            image.pixels()
        file.write_bytes(b"bytes that are no image of a known kind")
        with self.assertRaisesRegex(faqem.UnsupportedError, "colours.png"):
            faqem.load(self.folder / "grid.obj").images[0].pixels()
        file.write_bytes(b"no image")
        model = faqem.load(self.folder / "grid.obj")
        self.assertEqual(len(model.images), 0)
        self.assertTrue(any("colours.png" in warning for warning in model.warnings))

    def test_arrays_are_not_copied_and_outlive_the_model(self):
        model = self.textured(self.pixels)
        first, second = model.parts[0], model.parts[0]
        image = model.images[0]
        for a, b in ((first.vertices, second.vertices), (first.triangles, second.triangles), (first.uvs[0], second.uvs[0]),
                     (first.materials, second.materials)):
            self.assertEqual(a.ctypes.data, b.ctypes.data)
            with self.assertRaises(ValueError):
                a[...] = 0
        vertices, rows = first.vertices, image.pixels()[1:]
        expected = vertices.copy()
        del model, first, second, a, b
        gc.collect()
        again = [self.textured(self.pixels) for _ in range(20)]  # would use memory that was freed
        assert_array_equal(vertices, expected)
        assert_array_equal(rows, self.pixels[1:])
        assert_array_equal(image.pixels(), self.pixels)
        self.assertEqual(len(again), 20)


if __name__ == "__main__":
    unittest.main()
