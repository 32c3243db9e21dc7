"""Untried: Spack has not built this yet. `spack repo add packaging/spack && spack install listric`."""

from pathlib import Path

from spack.package import conflicts, depends_on, generator, license, variant, version

try:
    from spack_repo.builtin.build_systems.cmake import CMakePackage
except ImportError:  # before Spack 1.0
    from spack.package import CMakePackage


class Listric(CMakePackage):
    """Numerical sandbox for halfgrabens: bonded discs on a listric or ramp-flat detachment."""

    git = f"file://{Path(__file__).resolve().parents[4]}"  # the clone that this recipe is of

    license("Apache-2.0")

    version("main", branch="main")

    variant("fem", default=False, description="Build the plug-in for elastic bases")
    variant("mpi", default=False, description="Build the plug-in for runs over MPI")

    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("hdf5~mpi", when="~fem~mpi")
    depends_on("hdf5", when="+fem")
    depends_on("hdf5", when="+mpi")
    depends_on("tomlplusplus")
    depends_on("fmt")
    depends_on("cli11")
    depends_on("nlohmann-json")
    depends_on("eigen@3.4:")
    depends_on("pugixml")
    depends_on("zlib-api")
    depends_on("dealii@9.4:+mpi+petsc+p4est", when="+fem")
    depends_on("petsc+mpi", when="+mpi")
    depends_on("mpi", when="+mpi")
    depends_on("python@3.11:", type="run")
    depends_on("py-numpy", type="run")
    depends_on("py-matplotlib", type="run")
    depends_on("py-h5py", type="run")

    generator("ninja")
    conflicts("%gcc@:11")

    def cmake_args(self):
        return [self.define("LISTRIC_PORTABLE", True),
                self.define_from_variant("LISTRIC_FEM", "fem"),
                self.define_from_variant("LISTRIC_RANKS", "mpi")]
