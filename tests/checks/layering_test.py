import unittest

from layering import ELEMENTS, HEAVY, RANKS, ROOF_OF_DEM, SPECIFICATION, violations
from source_tree import read_tree, unit


def included(path, *lines):
    return {path: "".join(f"#include {line}\n" for line in lines)}


class PlantedViolations(unittest.TestCase):
    def found(self, *trees):
        return violations({path: text for planted in trees for path, text in planted.items()})

    def test_a_room_that_looks_up(self):
        self.assertEqual(
            self.found(included("apps/scene/scene.cpp", '"apps/scene/scene.hpp"',
                                '"apps/support/error.hpp"', '"dem/base.hpp"', "<toml++/toml.h>",
                                '"apps/model/effects.hpp"', '"apps/run/run.hpp"')),
            ["apps/scene/scene.cpp: must not include apps/model/effects.hpp",
             "apps/scene/scene.cpp: must not include apps/run/run.hpp"])

    def test_a_sub_room_belongs_to_its_room(self):
        self.assertEqual(
            self.found(included("apps/model/effects/compaction.cpp", '"apps/scene/scene.hpp"',
                                '"apps/model/effect.hpp"', '"apps/archive/snapshot/snapshot.hpp"')),
            ["apps/model/effects/compaction.cpp: must not include apps/archive/snapshot/snapshot.hpp"])

    def test_a_scene_in_measures(self):
        self.assertEqual(
            self.found(included("apps/measures/faults/fault.hpp", '"apps/support/statistics.hpp"',
                                '"dem/state.hpp"', "<vector>", '"apps/scene/scene.hpp"',
                                '"fem/footwall.hpp"', "<fmt/format.h>")),
            ["apps/measures/faults/fault.hpp: must not include apps/scene/scene.hpp",
             "apps/measures/faults/fault.hpp: must not include fem/footwall.hpp",
             "apps/measures/faults/fault.hpp: must not include fmt/format.h"])

    def test_a_file_in_no_room(self):
        self.assertEqual(self.found({"apps/main.cpp": "", "apps/helper.cpp": "",
                                     "apps/tools/helper.py": "",
                                     "apps/python/listric/run.py": "",
                                     "apps/python/listric/helper.cpp": ""}),
                         ["apps/helper.cpp: lies in no room",
                          "apps/tools/helper.py: lies in no room",
                          "apps/python/listric/helper.cpp: lies in no room"])

    def test_a_cycle_of_units(self):
        self.assertEqual(
            self.found(included("dem/base.cpp", '"dem/base.hpp"', '"dem/fast.hpp"'),
                       included("dem/base.hpp", "<vector>"),
                       included("dem/fast.cpp", '"dem/fast.hpp"', '"dem/law.hpp"'),
                       included("dem/fast.hpp", '"dem/state.hpp"'),
                       included("dem/state.hpp"),
                       included("dem/law.hpp", '"dem/base.hpp"')),
            ["cycle of units: dem/base, dem/fast, dem/law"])

    def test_a_header_with_its_source_is_no_cycle(self):
        self.assertEqual(self.found(included("dem/cycle/cycle.cpp", '"dem/cycle/cycle.hpp"'),
                                    included("dem/cycle/cycle.hpp", '"dem/state.hpp"')), [])

    def test_dem_beyond_the_standard_library(self):
        self.assertEqual(
            self.found(included("dem/cycle/cycle.cpp", "<vector>", "<cmath>", '"dem/state.hpp"',
                                "<immintrin.h>", "<unistd.h>", '"fem/footwall.hpp"',
                                "<fmt/core.h> // a comment", '"../apps/run.hpp"', '"state.hpp"',
                                '"dem/../fem/mesh.hpp"', "HEADER")),
            [f"dem/cycle/cycle.cpp: must not include {name}" for name in
             ("unistd.h", "fem/footwall.hpp", "fmt/core.h", "../apps/run.hpp", "state.hpp",
              "dem/../fem/mesh.hpp", "HEADER")])

    def test_finite_elements_outside_the_plug_in(self):
        self.assertEqual(
            self.found(included("fem/mesh.cpp", '"fem/mesh.hpp"', '"fem/footwall.hpp"',
                                "<deal.II/grid/tria.h>", "<petscksp.h>", '"dem/state.hpp"'),
                       included("fem/plate.cpp", "<dlfcn.h>", "<deal.II/grid/tria.h>",
                                '"fem/mesh.hpp"'),
                       included("coupling/modes.cpp", "<Eigen/Dense>", '"fem/footwall.hpp"',
                                '"fem/mesh.hpp"', '"apps/scene/scene.hpp"'),
                       included("apps/model/footwall.cpp", '"fem/footwall.hpp"', "<petsc.h>",
                                '"fem/elasticity.hpp"')),
            ["fem/mesh.cpp: must not include dem/state.hpp",
             "fem/plate.cpp: must not include deal.II/grid/tria.h",
             "fem/plate.cpp: must not include fem/mesh.hpp",
             "coupling/modes.cpp: must not include fem/mesh.hpp",
             "coupling/modes.cpp: must not include apps/scene/scene.hpp",
             "apps/model/footwall.cpp: must not include petsc.h",
             "apps/model/footwall.cpp: must not include fem/elasticity.hpp"])

    def test_mpi_outside_its_plug_in(self):
        self.assertEqual(
            self.found(included("dem/ranks/mpi/mpi_ranks.cpp", "<mpi.h>", "<petscsys.h>",
                                "<petscksp.h>", '"dem/ranks/ranks.hpp"',
                                '"dem/ranks/mpi/require.hpp"', '"apps/run/run.hpp"'),
                       included("dem/ranks/halo_exchange.cpp", "<mpi.h>", '"dem/ranks/ranks.hpp"'),
                       included("apps/run/ranks/ranked_run.cpp", '"dem/ranks/mpi/mpi_ranks.hpp"'),
                       included("apps/run/ranks/join_ranks.cpp", "<dlfcn.h>", "<mpi.h>")),
            ["dem/ranks/mpi/mpi_ranks.cpp: must not include petscksp.h",
             "dem/ranks/mpi/mpi_ranks.cpp: must not include apps/run/run.hpp",
             "dem/ranks/halo_exchange.cpp: must not include mpi.h",
             "apps/run/ranks/ranked_run.cpp: must not include dem/ranks/mpi/mpi_ranks.hpp",
             "apps/run/ranks/join_ranks.cpp: must not include mpi.h"])

    def test_a_floor_of_dem_that_looks_up(self):
        self.assertEqual(
            self.found(included("dem/state.hpp", '"dem/column.hpp"', '"dem/threads/team.hpp"',
                                '"dem/base/place.hpp"'),
                       included("dem/cycle/fast_cycle.cpp", '"dem/contacts/contacts.hpp"',
                                '"dem/cycle/surroundings.hpp"', '"dem/ranks/subdomain.hpp"'),
                       included("dem/threads/team.cpp", '"dem/law.hpp"'),
                       included("dem/genesis/genesis.cpp", '"dem/simulation.hpp"'),
                       included("dem/simulation.cpp", '"dem/events/strain.hpp"',
                                '"dem/cycle/cycle.hpp"')),
            ["dem/state.hpp: must not include dem/base/place.hpp, of a floor above",
             "dem/cycle/fast_cycle.cpp: must not include dem/ranks/subdomain.hpp, of a floor above",
             "dem/threads/team.cpp: must not include dem/law.hpp, of a floor above",
             "dem/genesis/genesis.cpp: must not include dem/simulation.hpp, of a floor above"])

    def test_a_file_on_no_floor_of_dem(self):
        self.assertEqual(self.found({"dem/helpers/sum.hpp": ""}),
                         ["dem/helpers/sum.hpp: lies on no floor of dem"])

    def test_a_specification_that_is_long(self):
        path = "dem/cycle/plain_cycle.cpp"
        self.assertEqual(self.found({path: "int f();\n" * 250}), [])
        self.assertEqual(self.found({path: "int f();\n" * 251}),
                         [f"{path}: 251 lines, at most 250: it is to be read"])

    def test_ranks_in_the_specification(self):
        path = "dem/cycle/plain_cycle.cpp"
        self.assertEqual(self.found({path: "// frank words of a cranked shaft\n"}), [])
        for line, word in (("// of all ranks\n", "ranks"), ("int rank_count;\n", "rank"),
                           ("if (is_ghost) {}\n", "ghost"), ("Halo* all;\n", "halo"),
                           ("RankedCycles c;\n", "ranked"), ("MPI_Comm c;\n", "mpi")):
            with self.subTest(line):
                self.assertEqual(self.found({path: line}), [f"{path}: {word}: that is for dem/ranks"])

    def test_a_header_that_is_slow_to_compile(self):
        slow = "must not include {}, which is slow to compile: the sources that need it do"
        for path, name, line in (("apps/scene/toml/shelf.hpp", "apps/scene/toml/toml.hpp", '"apps/scene/toml/toml.hpp"'),
                                 ("apps/scene/toml/shelf.hpp", "toml++/toml.h", "<toml++/toml.h>"),
                                 ("apps/run/run_view.hpp", "nlohmann/json.hpp", "<nlohmann/json.hpp>"),
                                 ("apps/support/statistics.hpp", "Eigen/Dense", "<Eigen/Dense>"),
                                 ("apps/run/run_view.hpp", "CLI/CLI.hpp", "<CLI/CLI.hpp>"),
                                 ("apps/support/words/pattern.hpp", "regex", "<regex>")):
            with self.subTest(path=path, name=name):
                self.assertEqual(self.found(included(path, line)), [f"{path}: {slow.format(name)}"])
                self.assertEqual(self.found(included(path.replace(".hpp", ".cpp"), line)), [])
        self.assertEqual(self.found(included("apps/archive/quality.hpp", "<nlohmann/json_fwd.hpp>")), [])

    def test_what_is_no_include(self):
        self.assertEqual(self.found({"dem/cycle/cycle.cpp": '// #include "apps/run/run.hpp"\n'
                                                      'int include;\n'}), [])

    def test_unusual_spelling_of_an_include(self):
        self.assertEqual(self.found({"dem/cycle/cycle.cpp": ' #  include\t"fem/plate.hpp"'}),
                         ["dem/cycle/cycle.cpp: must not include fem/plate.hpp"])


class Sources(unittest.TestCase):
    def test_keep_to_their_rooms(self):
        sources = read_tree()
        self.assertGreater(len(sources), 100, "no sources read")
        self.assertEqual(violations(sources), [])

    def test_what_has_rules_of_its_own_is_there(self):
        sources = read_tree()
        self.assertLessEqual(SPECIFICATION, sources.keys())
        self.assertLessEqual(ELEMENTS | RANKS | ROOF_OF_DEM, {unit(path) for path in sources})
        self.assertLessEqual(set().union(*HEAVY.values()), sources.keys())


if __name__ == "__main__":
    unittest.main()
