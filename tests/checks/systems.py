#!/usr/bin/env python3
"""What other systems are told to install is what CMake asks for: packaging/environment.yml, Spack's recipe and
the tables of docs/start/install.md. All who name a version name that of CMakeLists.txt.

    python3 tests/checks/systems.py     prints what differs
"""

import ast
import re
from pathlib import Path

from source_tree import ROOT, report

FILES = ("CMakeLists.txt", "apps/CMakeLists.txt", "coupling/CMakeLists.txt", "fluid/CMakeLists.txt", "cmake/parts/fem.cmake",
         "cmake/parts/ranks.cmake")
ENVIRONMENT, RECIPE = "packaging/environment.yml", "packaging/spack/packages/listric/package.py"
INSTALL = "docs/start/install.md"
# Where the version stands besides CMakeLists.txt, and how.
VERSIONS = (("CITATION.cff", r"^version: (\S+)$"), ("apps/python/pyproject.toml", r'^version = "(\S+)"$'),
            ("docs/reference/citing.md", r", version (\S+), "), ("docs/reference/citing.md", r"  version = {(\S+)},"))
ASKED = re.compile(r"(?:find_package|pkg_search_module)\((\S+)")

# What CMake asks for: packages of Debian, Fedora, conda-forge and Spack; None: there is none.
NAMES = {
    "Threads": (None,) * 4,  # of the C library
    "PkgConfig": ("pkg-config", "pkgconf-pkg-config", "pkg-config", "pkgconfig"),
    "HDF5": ("libhdf5-dev", "hdf5-devel", "hdf5", "hdf5"),
    "tomlplusplus": ("libtomlplusplus-dev", "tomlplusplus-devel", "tomlplusplus", "tomlplusplus"),
    "fmt": ("libfmt-dev", "fmt-devel", "fmt", "fmt"),
    "CLI11": ("libcli11-dev", "cli11-devel", "cli11", "cli11"),
    "nlohmann_json": ("nlohmann-json3-dev", "json-devel", "nlohmann_json", "nlohmann-json"),
    "Eigen3": ("libeigen3-dev", "eigen3-devel", "eigen", "eigen"),
    "pugixml": ("libpugixml-dev", "pugixml-devel", "pugixml", "pugixml"),
    "ZLIB": ("zlib1g-dev", "zlib-devel", "zlib", "zlib-api"),
    "deal.II": ("libdeal.ii-dev", None, None, "dealii"),
    "PETSC": ("petsc-dev", None, None, "petsc"),
    "MPI": ("libopenmpi-dev", None, None, "mpi"),
}


def dependencies(recipe):
    """Names of what a Spack recipe depends on."""
    calls = [node for node in ast.walk(ast.parse(recipe))
             if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "depends_on"]
    return {re.match(r"[\w-]+", call.args[0].value)[0] for call in calls}


def listed(environment):
    """Names of an environment file's packages."""
    return set(re.findall(r"^  - ([\w.-]+)", environment.partition("dependencies:")[2], re.MULTILINE))


def other_versions(texts):
    version = re.search(r"^project\(listric VERSION (\S+)", texts["CMakeLists.txt"], re.MULTILINE)[1]
    found = [(path, re.search(pattern, texts[path], re.MULTILINE)) for path, pattern in VERSIONS]
    return [f"{path}: version {there[1] if there else 'none'}, CMakeLists.txt has {version}" for path, there in found
            if not there or there[1] != version]


def violations(texts):
    """`texts` are those of the files by their paths."""
    asked = {name for path in FILES for name in ASKED.findall(texts[path])}
    found = [f"{name}: CMake asks for it, NAMES of tests/checks/systems.py lacks it" for name in sorted(asked - NAMES.keys())]
    found += [f"{name}: NAMES of tests/checks/systems.py has it, CMake does not ask for it"
              for name in sorted(NAMES.keys() - asked)]
    words = set(re.findall(r"[\w.+-]+", texts[INSTALL]))
    places = ((INSTALL, words), (INSTALL, words), (ENVIRONMENT, listed(texts[ENVIRONMENT])),
              (RECIPE, dependencies(texts[RECIPE])))
    found += other_versions(texts)
    return found + [f"{path}: lacks {package}" for name in sorted(asked & NAMES.keys())
                    for package, (path, there) in zip(NAMES[name], places) if package and package not in there]


def read_all():
    return {path: Path(ROOT, path).read_text(encoding="utf-8") for path in (*FILES, ENVIRONMENT, RECIPE, INSTALL, *dict(VERSIONS))}


if __name__ == "__main__":
    raise SystemExit(report(violations(read_all())))
