"""Version and platform tag of the wheel, which pyproject.toml cannot express. Called by build_wheel.sh."""

import os

from setuptools import Distribution, setup
from wheel.bdist_wheel import bdist_wheel


class PlatformDistribution(Distribution):
    """A distribution that contains a compiled library."""

    def has_ext_modules(self):
        return True


class PlatformWheel(bdist_wheel):
    """A wheel for this platform and any Python 3, since the library does not use Python's C API."""

    def get_tag(self):
        return "py3", "none", super().get_tag()[2]


setup(version=os.environ["FAQEM_VERSION"], distclass=PlatformDistribution, cmdclass={"bdist_wheel": PlatformWheel})
