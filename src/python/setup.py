"""The parts that pyproject.toml cannot say: version and platform. build_wheel.sh is what to call."""

import os

from setuptools import Distribution, setup
from wheel.bdist_wheel import bdist_wheel


class PlatformDistribution(Distribution):
    """With a library inside."""

    def has_ext_modules(self):
        return True


class PlatformWheel(bdist_wheel):
    """For this platform and any Python 3: the library knows nothing of Python."""

    def get_tag(self):
        return "py3", "none", super().get_tag()[2]


setup(version=os.environ["FAQEM_VERSION"], distclass=PlatformDistribution, cmdclass={"bdist_wheel": PlatformWheel})
