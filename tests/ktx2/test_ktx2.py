"""Tests of KTX2 images. Usage: test_ktx2.py FOLDER, with the Python module that has the plugin in PYTHONPATH

FOLDER has the same module without the plugin.
"""

import pathlib
import struct
import subprocess
import sys
import unittest

import alktx2
import faqem
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "docs" / "statements"))
from model import Gltf, gltf_grid

WIDTH, HEIGHT = 62, 47
KINDS = {
    "ETC1S": {"codec": "etc1s", "quality": 90},
    "ETC1S with levels": {"codec": "etc1s", "mipmaps": True},
    "UASTC with Zstandard": {"codec": "uastc", "zstd_supercompression_level": 6},
}
SIDE = 16  # quads along a side of the model: enough that results have fewer bytes than either file


def picture(has_alpha, width=WIDTH, height=HEIGHT):
    """RGBA of smooth colours, whose last columns are translucent."""
    y, x = numpy.mgrid[0:height, 0:width]
    alpha = numpy.where(has_alpha & (x > 40), 96, 255)
    return numpy.stack([4 * x, 5 * y, 128 + 40 * numpy.sin(x / 9), alpha], axis=-1).astype(numpy.uint8)


def encoded(kind, has_alpha=False, width=WIDTH, height=HEIGHT):
    pixels = picture(has_alpha, width, height).tobytes()
    return alktx2.encode_raw_rgba_to_ktx2(pixels, width, height, has_alpha, threads=1, **KINDS[kind])


def decoded_by_alktx2(ktx2):
    """A PNG of whole blocks of 4 x 4 pixels."""
    return alktx2.decode_ktx2_to_bytes(ktx2, format="png")[0]


def model(image, mime_type="image/ktx2"):
    """A GLB of a bumpy square with one texture."""
    glb = gltf_grid({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicFactor": 0}}, side=SIDE)
    glb.add("images", {"name": "wood", "bufferView": glb.view(image), "mimeType": mime_type})
    if mime_type == "image/ktx2":
        glb.add("textures", {"extensions": {"KHR_texture_basisu": {"source": 0}}})
        glb.json["extensionsUsed"] = glb.json["extensionsRequired"] = ["KHR_texture_basisu"]
    else:
        glb.add("textures", {"source": 0})
    return glb.bytes()


def document_of(glb):
    return Gltf(glb, {"warnings": []}).json


def pixels_of(image, mime_type="image/ktx2"):
    return faqem.Model.from_glb(model(image, mime_type)).images[0].pixels()


def changed(content, at, form, *values):
    result = bytearray(content)
    struct.pack_into(form, result, at, *values)
    return bytes(result)


class Ktx2(unittest.TestCase):
    def test_pixels_are_those_of_another_reader_and_close_to_the_original(self):
        for kind in KINDS:
            for has_alpha in (False, True):
                ktx2 = encoded(kind, has_alpha)
                found = pixels_of(ktx2)
                self.assertEqual(found.shape, (HEIGHT, WIDTH, 4 if has_alpha else 3))
                other = pixels_of(decoded_by_alktx2(ktx2), "image/png")
                numpy.testing.assert_array_equal(found, other[:HEIGHT, :WIDTH])
                self.assertLess(numpy.abs(found - picture(has_alpha)[..., : found.shape[2]].astype(float)).mean(), 6)

    def test_the_texture_is_baked_as_one_of_a_png(self):
        ktx2 = encoded("UASTC with Zstandard", width=64, height=48)
        results = [
            faqem.simplify(faqem.Model.from_glb(glb), ratio=0.5, bake="atlas", texture_size=64).to_glb()
            for glb in (model(ktx2), model(decoded_by_alktx2(ktx2), "image/png"))]
        self.assertEqual(*results)
        self.assertNotIn("extensionsRequired", document_of(results[0]))

    def test_kept_uvs_keep_the_file(self):
        ktx2 = encoded("UASTC with Zstandard")
        result = faqem.simplify(faqem.Model.from_glb(model(ktx2)), ratio=0.5, bake="keep", texture_size=64)
        self.assertEqual([image.encoded for image in result.images], [ktx2])
        self.assertEqual(document_of(result.to_glb())["extensionsRequired"], ["KHR_texture_basisu"])

    def test_without_the_plugin_images_stay_as_they_are(self):
        program = (
            "import faqem, sys; r = faqem.simplify(faqem.Model.from_glb(sys.stdin.buffer.read()), ratio=0.5)\n"
            "print(r.warnings, file=sys.stderr); sys.stdout.buffer.write(r.images[0].encoded)")
        ktx2 = encoded("ETC1S")
        run = subprocess.run([sys.executable, "-B", "-c", program], input=model(ktx2), capture_output=True, check=True,
                             env={"PYTHONPATH": sys.argv[1]})
        self.assertEqual(run.stdout, ktx2)
        self.assertIn("cannot be baked", run.stderr.decode())

    def test_other_kinds_of_ktx2_are_refused_by_name(self):
        ktx2 = encoded("ETC1S")
        astc = alktx2.encode_raw_rgba_to_ktx2(picture(False).tobytes(), WIDTH, HEIGHT, False, codec="astc_ldr", threads=1)
        for other in (changed(ktx2, 28, "<I", 2), changed(ktx2, 32, "<I", 2), changed(ktx2, 36, "<I", 6), astc):
            with self.assertRaisesRegex(faqem.UnsupportedError, "image 'wood': is a KTX2 image of"):
                pixels_of(other)

    def test_damaged_files_are_errors_that_name_the_image(self):
        for kind in KINDS:
            ktx2 = encoded(kind, True)
            for size in range(16, len(ktx2)):
                with self.assertRaisesRegex(faqem.Error, "image 'wood'"):
                    pixels_of(ktx2[:size])
            for at in range(12, len(ktx2)):
                for bit in (1, 64, 255):
                    try:
                        pixels_of(changed(ktx2, at, "B", ktx2[at] ^ bit))
                    except faqem.Error as error:
                        self.assertIn("image 'wood'", str(error))
        for size in (0, 16385, 2**32 - 1):
            with self.assertRaisesRegex(faqem.InputError, "image 'wood': is"):
                pixels_of(changed(ktx2, 20, "<II", size, size))
        with self.assertRaisesRegex(faqem.InputError, "is damaged"):
            pixels_of(changed(ktx2, 20, "<II", 16384, 16384))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
